// gl_window: shadow maps of any format, effects and kernel that can be chosen while the program runs.
#pragma once

#include <gl_headless/gpu_scene.hpp>

#include <memory>

namespace gl_window {

namespace gl = gnomon::gl;

inline constexpr int map_side = 512, tile_size = 16;

/// What a person turns on and off.
struct choice {
    int format = 1; ///< 0 to 3: 8, 16, half, 32 bits
    bool far_bound = true;
    bool translucency = true;
    bool gaussian = true; ///< or a box
    bool wide = true;     ///< a radius of 8 texels, or of 3
    gnomon::bias_towards towards = gnomon::bias_towards::shadow;

    friend bool operator==(const choice&, const choice&) = default;
    [[nodiscard]] int radius() const noexcept { return wide ? 8 : 3; }
};
inline constexpr const char* format_names[] = {"8 bit", "16 bit", "half", "32 bit"};

/// A soft_shadow_map of some texel and kernel.
class shadow_map {
  public:
    virtual ~shadow_map() = default;
    /// Why there is no such map.
    [[nodiscard]] virtual const gl::problem& problem() const = 0;
    /// Clears, casts, bounds and filters.
    virtual void draw(const gl_headless::gpu_scene& s) = 0;
    [[nodiscard]] virtual unsigned soft_texture() const = 0;
    [[nodiscard]] virtual const gnomon::tile_grid& tiles() const = 0;
    /// GLSL that decides about receivers.
    [[nodiscard]] virtual std::string receive_text() const = 0;
    /// What the GPU decides for points of the map.
    [[nodiscard]] virtual std::vector<float> receive(const gallery::receivers& points) const = 0;
    [[nodiscard]] virtual gallery::kernel_weights weights() const = 0;
    [[nodiscard]] virtual int bytes_per_texel() const = 0;
};

/// The programs of a choice are compiled here, and shared by `run` with those that were chosen before.
[[nodiscard]] std::unique_ptr<shadow_map> make_map(const choice& c, const gl::backend& run);

} // namespace gl_window
