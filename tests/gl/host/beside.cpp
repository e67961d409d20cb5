// gl/ in a file that includes what gives its host GL, before gnomon or after it: neither may hear of the other. CMakeLists.txt compiles
// this with every such header that is installed.
#ifdef HOST_BEFORE
#include HOST_BEFORE
#endif

#include <gnomon/gl/program.hpp>
#include <gnomon/gl/state.hpp>

#ifdef HOST_AFTER
#include HOST_AFTER
#endif

namespace {

/// A host that knows GL by its own loader and names, and gives gnomon both.
bool draw(void* (*get_proc_address)(const char*), GLuint texture, GLenum target) {
    const gnomon::gl::functions table = gnomon::gl::load(get_proc_address);
    const auto context = gnomon::gl::context::of(table);
    if (!context) return false;
    const gnomon::gl::state_guard<gnomon::gl::state_policy::restore> guard(*context);
    context->gl->BindTexture(target, texture);
    return static_cast<bool>(gnomon::gl::make_program(*context, "", ""));
}

} // namespace

int main() {
    return static_cast<int>(draw([](const char*) -> void* { return nullptr; }, GLuint{1}, GL_TEXTURE_2D));
}
