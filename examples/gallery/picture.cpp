#include "picture.hpp"

#include "failure.hpp"

#include <stb_easy_font.h>
#include <stb_image_resize.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gallery {

namespace {
unsigned char to_srgb(float linear) noexcept {
    const float v = (std::min)((std::max)(linear, 0.0f), 1.0f);
    return static_cast<unsigned char>((v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f) * 255.0f + 0.5f);
}

/// stb_easy_font draws with quads; each is an upright rectangle.
struct corner {
    float x, y, z;
    std::array<unsigned char, 4> colour;
};
static_assert(sizeof(corner) == 16);
} // namespace

picture::picture(int width, int height, unsigned char grey)
    : width_(width), height_(height), pixels_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), grey) {}

void picture::set(int x, int y, const glm::vec3& linear) noexcept {
    for (int c = 0; c < 3; ++c) at(x, y)[c] = to_srgb(linear[c]);
}

void picture::place(const picture& other, int x, int y) noexcept {
    const int rows = (std::min)(other.height_, height_ - y), columns = (std::min)(other.width_, width_ - x);
    for (int row = 0; row < rows && columns > 0; ++row)
        std::copy_n(other.data() + 3 * static_cast<std::ptrdiff_t>(row) * other.width_, 3 * columns, at(x, y + row));
}

void picture::write(const std::string& text, int x, int y, int scale, unsigned char grey) {
    std::vector<corner> corners(text.size() * 80);
    std::string line = text; // the font takes char*, though it changes nothing
    const int quads =
        stb_easy_font_print(0.0f, 0.0f, line.data(), nullptr, corners.data(), static_cast<int>(corners.size() * sizeof(corner)));
    for (int q = 0; q < quads; ++q) {
        const corner &first = corners[static_cast<std::size_t>(4 * q)], &last = corners[static_cast<std::size_t>(4 * q + 2)];
        const auto dot = [scale](float v) { return static_cast<int>(v * static_cast<float>(scale)); };
        for (int j = (std::max)(0, y + dot(first.y)); j < (std::min)(height_, y + dot(last.y)); ++j)
            for (int i = (std::max)(0, x + dot(first.x)); i < (std::min)(width_, x + dot(last.x)); ++i)
                std::fill_n(at(i, j), 3, grey);
    }
}

picture resized(const picture& p, int width, int height) {
    picture result(width, height);
    if (!stbir_resize_uint8_srgb(p.data(), p.width(), p.height(), 0, result.data(), width, height, 0, 3, STBIR_ALPHA_CHANNEL_NONE,
                                 0))
        throw failure("there is no memory left to resize a picture");
    return result;
}

std::string png(const picture& p) {
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    if (!stbi_write_png_to_func(append, &bytes, p.width(), p.height(), 3, p.data(), 3 * p.width()))
        throw failure("there is no memory left to write a picture");
    return bytes;
}

} // namespace gallery
