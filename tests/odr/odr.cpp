// Linked into every test program, and uses nothing: a function in a header that is not inline is then defined twice.
#include "all_headers.hpp"
