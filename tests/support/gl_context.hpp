// GL contexts without a display, through an EGL that is opened at run time: no header of GL's, nothing to link but libdl. For tests with
// doctest see egl.hpp.
//
//     test::gl_context one(test::gl_3_3), two(test::gl_es);                     // several at once; the last made is current
//     if (!one) return say(one.why_not());
//     one.make_current();
//
// What Mesa reads from the environment, tried with 22.3: for every context anew MESA_GL_VERSION_OVERRIDE and
// MESA_GLSL_VERSION_OVERRIDE, so GL 3.3 and 4.5 may stand side by side; but only once, before the first context of the process,
// MESA_GLES_VERSION_OVERRIDE, MESA_EXTENSION_OVERRIDE and GALLIUM_DRIVER. So a process has one OpenGL ES and one rasteriser, chosen by
// whoever starts it, in words of GNOMON_TEST_GL; unset it is "4.5 3.3 es":
//     4.5 3.3 es    the kinds that in_every_gl_context tries
//     es3.0         es, of the lowest version, which Mesa then gives no 16-bit unorm
//     eight_bits    ES has no extension that lets it draw into anything but bytes
//     softpipe      Mesa's other rasteriser, a hundred times slower
//     zink          Mesa's GL over its Vulkan rasteriser (Debian: mesa-vulkan-drivers)
// GNOMON_TEST_EGL names the library, libEGL.so.1 if unset.
#pragma once

#include <gnomon/gl/context.hpp>

#include <dlfcn.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <type_traits>

namespace test {

/// Which context is asked for. Of OpenGL ES a process has one version, 3.0 or later.
struct gl_kind {
    bool es;
    int version;
    const char* name;
};
inline constexpr gl_kind gl_4_5{false, 45, "4.5"};
inline constexpr gl_kind gl_3_3{false, 33, "3.3"};
inline constexpr gl_kind gl_es{true, 30, "es"};

/// Does GNOMON_TEST_GL hold the word?
inline bool gl_asked_for(const std::string& word) {
    const char* given = std::getenv("GNOMON_TEST_GL");
    return (std::string(" ") + (given != nullptr ? given : "4.5 3.3 es") + ' ').find(' ' + word + ' ') != std::string::npos;
}

/// libEGL and its display without a screen; opened once, never closed.
class egl {
  public:
    using handle = void*;
    using function = void (*)();

    static const egl& library() {
        static const egl opened;
        return opened;
    }
    [[nodiscard]] const std::string& why_not() const { return why_not_; }

    function (*get_proc_address)(const char*) = nullptr;
    unsigned (*bind_api)(unsigned) = nullptr;
    handle (*create_context)(handle, handle, handle, const int*) = nullptr;
    unsigned (*destroy_context)(handle, handle) = nullptr;
    unsigned (*make_current)(handle, handle, handle, handle) = nullptr;
    handle display = nullptr;

  private:
    egl() {
        if (gl_asked_for("es3.0")) setenv("MESA_GLES_VERSION_OVERRIDE", "3.0", 1);
        if (gl_asked_for("softpipe")) setenv("GALLIUM_DRIVER", "softpipe", 1);
        if (gl_asked_for("zink")) {
            setenv("GALLIUM_DRIVER", "zink", 1);
            setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        }
        if (gl_asked_for("eight_bits"))
            setenv("MESA_EXTENSION_OVERRIDE", "-GL_EXT_texture_norm16 -GL_EXT_color_buffer_float -GL_EXT_color_buffer_half_float",
                   1);
        const char* given = std::getenv("GNOMON_TEST_EGL");
        const char* name = given != nullptr ? given : "libEGL.so.1";
        void* const library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) {
            why_not_ = std::string("no GL context: ") + name + " is not there (Debian: libegl1, libgl1-mesa-dri)";
            return;
        }
        const auto find = [&](auto& pointer, const char* function_name) {
            pointer = gnomon::gl::detail::as_function<std::remove_reference_t<decltype(pointer)>>(dlsym(library, function_name));
            if (pointer == nullptr) why_not_ = std::string("no GL context: ") + name + " has no " + function_name;
        };
        handle (*get_platform_display)(unsigned, void*, const std::intptr_t*) = nullptr;
        unsigned (*initialize)(handle, int*, int*) = nullptr;
        find(get_proc_address, "eglGetProcAddress");
        find(bind_api, "eglBindAPI");
        find(create_context, "eglCreateContext");
        find(destroy_context, "eglDestroyContext");
        find(make_current, "eglMakeCurrent");
        find(get_platform_display, "eglGetPlatformDisplay");
        find(initialize, "eglInitialize");
        if (!why_not_.empty()) return;
        constexpr unsigned surfaceless_mesa = 0x31DD, platform_device = 0x313F;
        display = get_platform_display(surfaceless_mesa, nullptr, nullptr);
        if (display != nullptr && initialize(display, nullptr, nullptr) != 0) return;
        // drivers other than Mesa's: the first GPU
        handle device = nullptr;
        int devices = 0;
        const auto query_devices =
            gnomon::gl::detail::as_function<unsigned (*)(int, handle*, int*)>(get_proc_address("eglQueryDevicesEXT"));
        if (query_devices != nullptr && query_devices(1, &device, &devices) != 0 && devices > 0)
            display = get_platform_display(platform_device, device, nullptr);
        if (devices == 0 || display == nullptr || initialize(display, nullptr, nullptr) == 0)
            why_not_ = std::string("no GL context: ") + name + " has no display without a screen (Debian: libgl1-mesa-dri)";
    }

    std::string why_not_ = {};
};

/// A context of its own, current from its making on; or the sentence why it cannot be had.
class gl_context {
  public:
    explicit gl_context(gl_kind kind) {
        const egl& library = egl::library();
        why_not_ = library.why_not();
        if (!why_not_.empty()) return;
        create(kind);
        if (handle_ == nullptr) {
            why_not_ = std::string("no GL context of kind ") + kind.name;
            return;
        }
        make_current();
        functions_ = gnomon::gl::load(library.get_proc_address);
        const auto seen = gnomon::gl::context::of(functions_);
        if (!seen) {
            why_not_ = "no GL context: " + seen.error().sentence;
            return;
        }
        context_ = *seen;
        const auto* renderer = reinterpret_cast<const char*>(functions_.GetString(gnomon::gl::enums::renderer));
        name_ = (context_.es ? "ES " : "GL ") + std::to_string(context_.version / 10) + '.' +
                std::to_string(context_.version % 10) + ' ' + std::string(renderer).substr(0, std::string(renderer).find(' '));
        if (gl_asked_for("eight_bits")) name_ += ", eight bits";
    }
    ~gl_context() {
        if (handle_ == nullptr) return;
        if (current() == this) make_none_current();
        egl::library().destroy_context(egl::library().display, handle_);
    }
    gl_context(const gl_context&) = delete;
    gl_context& operator=(const gl_context&) = delete;

    [[nodiscard]] explicit operator bool() const { return why_not_.empty(); }
    [[nodiscard]] const std::string& why_not() const { return why_not_; }
    [[nodiscard]] const gnomon::gl::functions& functions() const { return functions_; }
    [[nodiscard]] const gnomon::gl::context& context() const { return context_; }
    /// "GL 3.3 llvmpipe"
    [[nodiscard]] const std::string& name() const { return name_; }

    void make_current() {
        egl::library().make_current(egl::library().display, nullptr, nullptr, handle_);
        current() = this;
    }
    static void make_none_current() {
        egl::library().make_current(egl::library().display, nullptr, nullptr, nullptr);
        current() = nullptr;
    }
    /// The one that is current, or null.
    static gl_context*& current() {
        static gl_context* now = nullptr;
        return now;
    }

  private:
    /// A variable of the environment for as long as this lives, unless it is set already.
    class variable {
      public:
        variable(const char* name, const std::string& value) : name_(name), set_(std::getenv(name) == nullptr) {
            if (set_) setenv(name, value.c_str(), 1);
        }
        ~variable() {
            if (set_) unsetenv(name_);
        }
        variable(const variable&) = delete;
        variable& operator=(const variable&) = delete;

      private:
        const char* name_;
        bool set_;
    };

    void create(gl_kind kind) {
        constexpr int major = 0x3098, minor = 0x30FB, profile = 0x30FD, core = 1, end = 0x3038;
        constexpr unsigned gl_api = 0x30A2, es_api = 0x30A0;
        const egl& library = egl::library();
        const int version[] = {major, kind.version / 10, minor, kind.version % 10, kind.es ? end : profile, core, end};
        const std::string text = std::to_string(kind.version / 10) + '.' + std::to_string(kind.version % 10);
        std::optional<variable> gl_version, glsl_version; // without them Mesa gives the latest it has
        if (!kind.es && kind.version < 45) {              // or they would promise what is not there
            gl_version.emplace("MESA_GL_VERSION_OVERRIDE", text);
            glsl_version.emplace("MESA_GLSL_VERSION_OVERRIDE", std::to_string(10 * kind.version));
        }
        library.bind_api(kind.es ? es_api : gl_api);
        handle_ = library.create_context(library.display, nullptr, nullptr, version);
    }

    egl::handle handle_ = nullptr;
    gnomon::gl::functions functions_ = {};
    gnomon::gl::context context_ = {};
    std::string name_ = {};
    std::string why_not_ = {};
};

} // namespace test
