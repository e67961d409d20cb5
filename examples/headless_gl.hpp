// A GL context without a display: EGL, opened at run time, without any surface. No header of GL's, nothing to link but libdl.
#pragma once

#include <dlfcn.h>

#include <cstdint>
#include <string>

/// Current from its making on, for as long as it lives. Draws into framebuffers of textures: there is no other.
class headless_gl {
  public:
    enum class api { desktop, es };

    /// GL of at least `version` (33: 3.3, core), or OpenGL ES of at least it (30: 3.0); Mesa gives the latest it has.
    explicit headless_gl(api which, int version, const std::string& library = "libEGL.so.1") {
        open(library);
        if (why_not_.empty()) make(which, version);
    }
    ~headless_gl() {
        if (context_ == nullptr) return;
        make_current_(display_, nullptr, nullptr, nullptr);
        destroy_context_(display_, context_);
    }
    headless_gl(const headless_gl&) = delete;
    headless_gl& operator=(const headless_gl&) = delete;

    [[nodiscard]] explicit operator bool() const noexcept { return why_not_.empty(); }
    /// A sentence; empty where there is a context.
    [[nodiscard]] const std::string& why_not() const noexcept { return why_not_; }
    /// A function of GL by its name. \pre there is a context
    [[nodiscard]] void* get_proc_address(const char* name) const { return get_proc_address_(name); }

  private:
    using handle = void*;
    static constexpr const char* advice = "; on Debian or Ubuntu: apt-get install --no-install-recommends libegl1 libgl1-mesa-dri";

    template <typename F> void find(F*& pointer, const std::string& library, const char* name) {
        pointer = reinterpret_cast<F*>(dlsym(library_, name));
        if (pointer == nullptr && why_not_.empty()) why_not_ = library + " has no " + name;
    }

    void open(const std::string& library) {
        library_ = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL); // never closed: drivers do not like it
        if (library_ == nullptr) {
            why_not_ = "there is no EGL here, for '" + library + "' cannot be opened" + advice;
            return;
        }
        handle (*get_platform_display)(unsigned, void*, const std::intptr_t*) = nullptr;
        unsigned (*initialize)(handle, int*, int*) = nullptr;
        find(get_platform_display, library, "eglGetPlatformDisplay");
        find(initialize, library, "eglInitialize");
        find(bind_api_, library, "eglBindAPI");
        find(create_context_, library, "eglCreateContext");
        find(make_current_, library, "eglMakeCurrent");
        find(destroy_context_, library, "eglDestroyContext");
        find(get_proc_address_, library, "eglGetProcAddress");
        if (!why_not_.empty()) return;
        if (!open_display(get_platform_display, initialize))
            why_not_ = "'" + library + "' has no display without a screen" + advice;
    }

    /// Mesa's display without a surface, or the first GPU of other drivers.
    template <typename GetPlatformDisplay, typename Initialize>
    bool open_display(const GetPlatformDisplay& get_platform_display, const Initialize& initialize) {
        constexpr unsigned surfaceless_mesa = 0x31DD, platform_device = 0x313F;
        display_ = get_platform_display(surfaceless_mesa, nullptr, nullptr);
        if (display_ != nullptr && initialize(display_, nullptr, nullptr) != 0) return true;
        handle device = nullptr;
        int devices = 0;
        const auto query_devices = reinterpret_cast<unsigned (*)(int, handle*, int*)>(get_proc_address_("eglQueryDevicesEXT"));
        if (query_devices == nullptr || query_devices(1, &device, &devices) == 0 || devices == 0) return false;
        display_ = get_platform_display(platform_device, device, nullptr);
        return display_ != nullptr && initialize(display_, nullptr, nullptr) != 0;
    }

    void make(api which, int version) {
        constexpr unsigned es_api = 0x30A0, desktop_api = 0x30A2;
        constexpr int major = 0x3098, minor = 0x30FB, profile = 0x30FD, core = 1, end = 0x3038;
        const bool es = which == api::es;
        const int wanted[] = {major, version / 10, minor, version % 10, es ? end : profile, core, end};
        if (bind_api_(es ? es_api : desktop_api) != 0) context_ = create_context_(display_, nullptr, nullptr, wanted);
        if (context_ != nullptr && make_current_(display_, nullptr, nullptr, context_) != 0) return;
        why_not_ = std::string("EGL makes no context of ") + (es ? "OpenGL ES " : "OpenGL ") + std::to_string(version / 10) + "." +
                   std::to_string(version % 10) + advice;
    }

    std::string why_not_ = {};
    void* library_ = nullptr;
    handle display_ = nullptr, context_ = nullptr;
    unsigned (*bind_api_)(unsigned) = nullptr;
    handle (*create_context_)(handle, handle, handle, const int*) = nullptr;
    unsigned (*make_current_)(handle, handle, handle, handle) = nullptr;
    unsigned (*destroy_context_)(handle, handle) = nullptr;
    void* (*get_proc_address_)(const char*) = nullptr;
};
