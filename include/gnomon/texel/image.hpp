// gnomon: soft shadow maps. Two-dimensional memory: a view of somebody's, and an owner of one's own.
#pragma once

#include <gnomon/rect.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {

/// `size` elements, `stride` bytes apart: one row of an image, a column, or any field of an array of structures. The stride keeps
/// the elements aligned: \pre stride is a multiple of alignof(T). At most 2^31 - 1 elements; more are left out.
template <typename T> class strided_span {
  public:
    using element_type = T;

    constexpr strided_span() noexcept = default;
    constexpr strided_span(T* data, int size, std::ptrdiff_t stride = sizeof(T)) noexcept
        : data_(data), size_(size > 0 ? size : 0), stride_(stride) {
        GNOMON_ASSERT(stride % static_cast<std::ptrdiff_t>(alignof(T)) == 0 &&
                          (std::is_constant_evaluated() || reinterpret_cast<std::uintptr_t>(data) % alignof(T) == 0),
                      "gnomon: the elements of a strided_span must be aligned, and stay so: its stride is in bytes");
    }
    template <std::size_t N> constexpr strided_span(T (&array)[N]) noexcept : strided_span(array, static_cast<int>(N)) {}
    /// From any contiguous range: std::span, std::vector, std::array.
    template <typename Range>
        requires requires(Range& r) {
            { r.data() } -> std::convertible_to<T*>;
            { r.size() } -> std::convertible_to<std::size_t>;
        }
    constexpr strided_span(Range&& range) noexcept
        : strided_span(range.data(), static_cast<int>(lesser<std::size_t>(range.size(), detail::int_max))) {}
    constexpr operator strided_span<const T>() const noexcept
        requires(!std::is_const_v<T>)
    {
        return {data_, size_, stride_};
    }

    [[nodiscard]] constexpr int size() const noexcept { return size_; }
    /// From an element to the next, in bytes.
    [[nodiscard]] constexpr std::ptrdiff_t stride() const noexcept { return stride_; }
    /// Do the elements lie side by side?
    [[nodiscard]] constexpr bool contiguous() const noexcept { return stride_ == static_cast<std::ptrdiff_t>(sizeof(T)); }
    [[nodiscard]] constexpr T& operator[](int i) const noexcept {
        if (contiguous()) return data_[i];
        using byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
        return *reinterpret_cast<T*>(reinterpret_cast<byte*>(data_) + stride_ * i);
    }

  private:
    T* data_ = nullptr;
    int size_ = 0;
    std::ptrdiff_t stride_ = sizeof(T);
};

template <typename Range> strided_span(Range&& range) -> strided_span<std::remove_pointer_t<decltype(range.data())>>;

/// A rectangle of texels in memory that somebody else owns, rows `stride` bytes apart: \pre stride is a multiple of alignof(T).
/// `data` is row 0; with a negative stride, which flips an image, that is the last row in memory. Without memory it is empty.
template <typename T> class image_view {
  public:
    using element_type = T;

    constexpr image_view() noexcept = default;
    image_view(T* data, extent size, std::ptrdiff_t stride) noexcept
        : data_(data), size_{data != nullptr ? greater(size.width, 0) : 0, data != nullptr ? greater(size.height, 0) : 0},
          stride_(stride) {
        GNOMON_ASSERT(data != nullptr || size.empty(), "gnomon: an image_view that is not empty needs memory");
        GNOMON_ASSERT(stride % static_cast<std::ptrdiff_t>(alignof(T)) == 0 &&
                          reinterpret_cast<std::uintptr_t>(data) % alignof(T) == 0,
                      "gnomon: the rows of an image_view must be aligned for its texels");
        GNOMON_ASSERT(std::is_const_v<T> || size_.height <= 1 ||
                          static_cast<std::ptrdiff_t>(sizeof(T)) * size_.width <= (stride < 0 ? -stride : stride),
                      "gnomon: the rows of an image_view that is written overlap: its stride is in bytes");
    }
    /// Rows that follow each other without a gap.
    image_view(T* data, extent size) noexcept : image_view(data, size, static_cast<std::ptrdiff_t>(sizeof(T)) * size.width) {}
    operator image_view<const T>() const noexcept
        requires(!std::is_const_v<T>)
    {
        return {data_, size_, stride_};
    }

    [[nodiscard]] constexpr extent size() const noexcept { return size_; }
    [[nodiscard]] constexpr int width() const noexcept { return size_.width; }
    [[nodiscard]] constexpr int height() const noexcept { return size_.height; }
    [[nodiscard]] constexpr std::ptrdiff_t stride() const noexcept { return stride_; }
    [[nodiscard]] constexpr T* data() const noexcept { return data_; }

    /// \pre 0 <= y < height
    [[nodiscard]] T* row(int y) const noexcept {
        using byte = std::conditional_t<std::is_const_v<T>, const std::byte, std::byte>;
        return reinterpret_cast<T*>(reinterpret_cast<byte*>(data_) + stride_ * y);
    }
    [[nodiscard]] strided_span<T> row_span(int y) const noexcept { return {row(y), size_.width}; }
    /// \pre the texel lies in the image
    [[nodiscard]] T& operator()(int x, int y) const noexcept { return row(y)[x]; }

    /// The part that `r` covers, clipped to the image.
    [[nodiscard]] image_view part(texel_rect r) const noexcept {
        r = clip(r, size_);
        return r.empty() ? image_view{} : image_view{row(r.y0) + r.x0, {r.width(), r.height()}, stride_};
    }
    /// Sets every texel; or every one of `r`, clipped to the image.
    void fill(const T& value) const noexcept
        requires(!std::is_const_v<T>)
    {
        fill(whole(size_), value);
    }
    void fill(texel_rect r, const T& value) const noexcept
        requires(!std::is_const_v<T>)
    {
        r = clip(r, size_);
        for (int y = r.y0; y < r.y1; ++y)
            for (T *t = row(y) + r.x0, *end = row(y) + r.x1; t != end; ++t) *t = value;
    }

  private:
    T* data_ = nullptr;
    extent size_{};
    std::ptrdiff_t stride_ = 0;
};

/// Have two images a texel in common? Rows that are not as far apart in the one as in the other have, where memory does: no more is
/// known of them.
template <typename T> [[nodiscard]] bool share_texels(image_view<const T> a, image_view<const T> b) noexcept {
    struct bytes {
        std::uintptr_t first, last, width, stride;
        explicit bytes(image_view<const T> v) noexcept
            : width(static_cast<std::size_t>(v.width()) * sizeof(T)),
              stride(static_cast<std::size_t>(v.stride() < 0 ? -v.stride() : v.stride())) {
            const auto top = reinterpret_cast<std::uintptr_t>(v.row(0)),
                       bottom = reinterpret_cast<std::uintptr_t>(v.row(v.height() - 1));
            first = lesser(top, bottom);
            last = greater(top, bottom) + width;
        }
    };
    if (a.size().empty() || b.size().empty()) return false;
    const bytes one(a), other(b);
    if (one.last <= other.first || other.last <= one.first) return false;
    if (one.stride != other.stride || one.stride < one.width) return true;
    const bool in_order = one.first <= other.first;
    const bytes &before = in_order ? one : other, &behind = in_order ? other : one;
    const std::uintptr_t column = (behind.first - before.first) % before.stride; // where in the rows of the one before
    return column < before.width || column + behind.width > before.stride;
}

/// An image that owns its memory. Every row begins on a 64-byte boundary, and an odd number of cache lines behind the one above: of rows
/// whose distance is a power of two a first cache may hold no more than eight, where nine taps read twelve.
/// Allocates in its constructors and never again. A negative side counts as zero. A moved-from image is empty.
template <typename T> class image {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 64,
                  "gnomon: image<T> holds plain texels: T must be trivially copyable");

  public:
    image() = default;
    explicit image(extent size, const T& fill = T{})
        : size_{greater(size.width, 0), greater(size.height, 0)}, lines_per_row_(lines_of(size_.width)),
          lines_(lines_per_row_ * static_cast<std::size_t>(size_.height)) {
        view().fill(whole(size_), fill);
    }
    image(const image&) = default;
    image& operator=(const image&) = default;
    image(image&& other) noexcept : size_(other.size_), lines_per_row_(other.lines_per_row_), lines_(std::move(other.lines_)) {
        other.size_ = {};
    }
    image& operator=(image&& other) noexcept {
        if (this == &other) return *this;
        size_ = other.size_;
        lines_per_row_ = other.lines_per_row_;
        lines_ = std::move(other.lines_);
        other.size_ = {};
        return *this;
    }
    ~image() = default;

    [[nodiscard]] extent size() const noexcept { return size_; }
    [[nodiscard]] image_view<T> view() noexcept { return {reinterpret_cast<T*>(lines_.data()), size_, stride()}; }
    [[nodiscard]] image_view<const T> view() const noexcept { return {reinterpret_cast<const T*>(lines_.data()), size_, stride()}; }
    [[nodiscard]] T& operator()(int x, int y) noexcept { return view()(x, y); }
    [[nodiscard]] const T& operator()(int x, int y) const noexcept { return view()(x, y); }

  private:
    struct alignas(64) line {
        std::byte bytes[64];
    };

    [[nodiscard]] static std::size_t lines_of(int width) noexcept {
        const std::size_t filled = (static_cast<std::size_t>(width) * sizeof(T) + sizeof(line) - 1) / sizeof(line);
        return filled | static_cast<std::size_t>(filled > 0);
    }
    [[nodiscard]] std::ptrdiff_t stride() const noexcept { return static_cast<std::ptrdiff_t>(lines_per_row_ * sizeof(line)); }

    extent size_{};
    std::size_t lines_per_row_ = 0;
    std::vector<line> lines_;
};

} // namespace gnomon::inline GNOMON_BUILD
