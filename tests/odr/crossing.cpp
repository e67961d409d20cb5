// Two files of which a gnomon type crosses from one to the other: a program if both have the same flags, and none if they have not.
#include <gnomon/receive/decide.hpp>

float depth_of(const gnomon::rg8& texel);

#ifdef GNOMON_TEST_OTHER_FILE
float depth_of(const gnomon::rg8& texel) { return gnomon::caster_depth(texel); }
#else
int main() { return depth_of(gnomon::rg8::caster(0.5f)) < 1.0f ? 0 : 1; }
#endif
