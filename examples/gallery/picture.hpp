// gallery: pictures, and what is done with them: shrink, label, put side by side, write as PNG.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gallery {

/// Pixels in sRGB, 8 bits a channel, row 0 at the top.
class picture {
  public:
    picture() = default;
    picture(int width, int height, unsigned char grey = 255);

    [[nodiscard]] int width() const noexcept { return width_; }
    [[nodiscard]] int height() const noexcept { return height_; }
    [[nodiscard]] const unsigned char* data() const noexcept { return pixels_.data(); }
    [[nodiscard]] unsigned char* data() noexcept { return pixels_.data(); }

    /// Sets a pixel to a colour in linear light; what is brighter than white becomes white. \pre inside
    void set(int x, int y, const glm::vec3& linear) noexcept;
    /// Copies another picture to (x, y), clipped.
    void place(const picture& other, int x, int y) noexcept;
    /// Writes one line of ASCII, its top left at (x, y), each dot of the font `scale` pixels wide.
    void write(const std::string& text, int x, int y, int scale, unsigned char grey);

  private:
    [[nodiscard]] unsigned char* at(int x, int y) noexcept {
        return pixels_.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<unsigned char> pixels_;
};

/// A smaller or larger one, resampled in linear light.
[[nodiscard]] picture resized(const picture& p, int width, int height);

/// The bytes of a PNG file.
[[nodiscard]] std::string png(const picture& p);

} // namespace gallery
