// gnomon: soft shadow maps. Texels between the host's memory and a GL texture, bit for bit in both directions.
#pragma once

#include <gnomon/gl/format.hpp>
#include <gnomon/texel/image.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {
namespace gl {

namespace detail {

/// What ReadPixels writes for one channel: halves come as floats, the only type that every context knows for them.
template <texel_format Texel>
using read_element =
    std::conditional_t<std::is_same_v<typename Texel::channel_type, half16>, float, typename Texel::channel_type::storage>;

template <texel_format Texel> [[nodiscard]] constexpr typename Texel::storage stored_from(read_element<Texel> read) noexcept {
    if constexpr (std::is_same_v<typename Texel::channel_type, half16>)
        return half_from(static_cast<double>(read)); // exact: it was a half
    else
        return read;
}

/// So many bytes are handed over at once, or one row, if that is more.
inline constexpr std::ptrdiff_t transfer_bytes = std::ptrdiff_t{1} << 20;
[[nodiscard]] constexpr int rows_at_once(int width, std::size_t bytes_per_texel, int height) noexcept {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(greater(width, 1)) * static_cast<std::ptrdiff_t>(bytes_per_texel);
    return static_cast<int>(greater<std::ptrdiff_t>(1, lesser<std::ptrdiff_t>(transfer_bytes / row, height)));
}

} // namespace detail

/// Reads texels out of a framebuffer. Allocates in its constructor and never again: a megabyte, or a row if that is more.
///
/// Any bits survive, but that of a half that is no number only that much is kept. Blocks until the GPU has drawn what is read.
template <texel_format Texel> class texel_reader {
  public:
    explicit texel_reader(extent size)
        : rows_(detail::rows_at_once(size.width, sizeof(row_texel), size.height)),
          staging_(size.empty() ? 0 : static_cast<std::size_t>(size.width) * static_cast<std::size_t>(rows_)) {}

    /// Reads `part` of the colour of a framebuffer into the same part of an image, row 0 first. Leaves it bound for reading.
    /// \pre a state_guard lives, and `part` is no wider than the size that this was made for
    void read(const context& c, unsigned from, image_view<Texel> to, texel_rect part) {
        part = clip(part, to.size());
        if (part.empty()) return;
        c.gl->BindFramebuffer(enums::read_framebuffer, from);
        for (int y0 = part.y0; y0 < part.y1; y0 += rows_) {
            const int y1 = lesser(part.y1, y0 + rows_);
            c.gl->ReadPixels(part.x0, y0, part.width(), y1 - y0, format_of<Texel>.read, format_of<Texel>.read_type,
                             staging_.data());
            const row_texel* next = staging_.data();
            for (int y = y0; y < y1; ++y)
                for (int x = part.x0; x < part.x1; ++x, ++next)
                    for (int i = 0; i < Texel::channels; ++i) to(x, y).stored[i] = detail::stored_from<Texel>(next->rgba[i]);
        }
    }

  private:
    struct row_texel {
        detail::read_element<Texel> rgba[4];
    };
    int rows_;
    std::vector<row_texel> staging_;
};

/// Writes texels into the texture that is bound to GL_TEXTURE_2D, whose format is format_of<Texel>. Allocates what it hands over.
/// \pre a state_guard lives
template <texel_format Texel> void write_texels(const context& c, image_view<const Texel> from) {
    constexpr int components = format_of<Texel>.channels;
    struct row_texel {
        typename Texel::storage stored[static_cast<std::size_t>(components)];
    };
    const int rows = detail::rows_at_once(from.width(), sizeof(row_texel), from.height());
    std::vector<row_texel> staging(static_cast<std::size_t>(from.width()) * static_cast<std::size_t>(rows));
    for (int y = 0; y < from.height(); y += rows) {
        const int end = lesser(from.height(), y + rows);
        row_texel* to = staging.data();
        for (int row = y; row < end; ++row)
            for (int x = 0; x < from.width(); ++x, ++to)
                for (int i = 0; i < Texel::channels; ++i) to->stored[i] = from(x, row).stored[i];
        c.gl->TexSubImage2D(enums::texture_2d, 0, 0, y, from.width(), end - y, format_of<Texel>.upload,
                            format_of<Texel>.upload_type, staging.data());
    }
}

} // namespace gl
} // namespace gnomon::inline GNOMON_BUILD
