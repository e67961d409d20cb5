// gnomon: soft shadow maps. An executor: whose threads the loops run on. The library starts none; it cuts its work into jobs.
//
//     const auto on_tbb = [](int count, const auto& job) { tbb::parallel_for(0, count, job); };
//     map.filter(on_tbb);
#pragma once

#include <gnomon/backend/backend.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace gnomon::inline GNOMON_BUILD {

namespace detail {
/// Stands for the jobs that an executor is given.
struct any_job {
    void operator()(int) const noexcept {}
};
} // namespace detail

/// A callable on(count, job) that calls job(i) once for every i in [0, count), in any order and on any threads, and returns when all
/// have ended and what they wrote can be seen. A job does not throw, blocks on nothing, and may be called by several threads at once.
/// Which bits a result has never depends on the executor.
template <typename On>
concept executor = std::invocable<On&, int, const detail::any_job&>;

/// One job after another, on the thread that asks.
struct sequential {
    template <typename Job> void operator()(int count, const Job& job) const {
        for (int i = 0; i < count; ++i) job(i);
    }
};
static_assert(executor<sequential>);

namespace detail {
/// Fewer texels are not worth the handing out.
inline constexpr int texels_in_a_band = 1 << 14;
/// Bands of so many texels, no more than `most`.
[[nodiscard]] constexpr int band_count(std::int64_t texels, int most, std::int64_t at_least = texels_in_a_band) noexcept {
    return static_cast<int>(lesser<std::int64_t>(texels / at_least + 1, most));
}
/// And of no fewer than this of a map of such a width. A box whose sums run makes them first of the rows around a band, 2R of them.
template <typename Backend, typename Kernel, typename Texel> [[nodiscard]] constexpr std::int64_t least_band(int width) noexcept {
    const std::int64_t around = sums_run<Backend, Kernel, Texel> ? std::int64_t{2} * Kernel::radius * width : 0;
    return greater<std::int64_t>(around, texels_in_a_band);
}
} // namespace detail

/// Scratch for a filter that runs in bands: one for each job that is handed out at once. Allocates in its constructor.
template <texel_format Texel, kernel Kernel> class band_scratch {
  public:
    /// More bands than threads: one that is interrupted then holds up less. Below 1 counts as 1.
    explicit band_scratch(int width, int bands = 32)
        : bands_(static_cast<std::size_t>(greater(bands, 1)), filter_scratch<Texel, Kernel>(width)) {}
    [[nodiscard]] int size() const noexcept { return static_cast<int>(bands_.size()); }
    [[nodiscard]] filter_scratch<Texel, Kernel>& operator[](int band) noexcept { return bands_[static_cast<std::size_t>(band)]; }

  private:
    std::vector<filter_scratch<Texel, Kernel>> bands_;
};

namespace detail {

template <typename On> consteval bool executor_is_callable() {
    static_assert(executor<On>, "gnomon: an executor is called as on(count, job) and calls job(i) for every i in [0, count): "
                                "[](int count, const auto& job) { for (int i = 0; i < count; ++i) job(i); }");
    return executor<On>;
}

/// Rows that a band is rounded to, for the lanes' sake.
inline constexpr int rows_in_a_band = 8;

/// The regions that walk(f) hands out, shared among bands of about the same area.
template <typename Walk> class band_cut {
  public:
    band_cut(const Walk& walk, int most, std::int64_t at_least = texels_in_a_band) noexcept
        : walk_(walk), texels_(texels_in(walk)), bands_(band_count(texels_, most, at_least)) {}

    [[nodiscard]] int size() const noexcept { return bands_; }
    /// Calls f(texel_rect) for what belongs to a band: whole rows of a region; each row belongs to one. A band too many has none.
    template <typename F> void for_each(int band, F&& f) const {
        const std::int64_t first = begin(band), last = begin(band + 1);
        std::int64_t at = 0;
        walk_([&](texel_rect r) {
            const int y0 = row(r, first - at), y1 = row(r, last - at);
            if (y0 < y1) f(texel_rect{r.x0, y0, r.x1, y1});
            at += std::int64_t{r.width()} * r.height();
        });
    }

  private:
    [[nodiscard]] std::int64_t begin(int band) const noexcept { return texels_ / bands_ * band + texels_ % bands_ * band / bands_; }
    /// The row of `r` that so many of its texels lie before.
    [[nodiscard]] static int row(texel_rect r, std::int64_t texels) noexcept {
        const std::int64_t rows = greater<std::int64_t>(texels, 0) / r.width();
        return rows >= r.height() ? r.y1 : r.y0 + static_cast<int>(rows) / rows_in_a_band * rows_in_a_band;
    }

    const Walk& walk_;
    std::int64_t texels_;
    int bands_;
};
template <typename Walk> band_cut(const Walk&, int, std::int64_t = 0) -> band_cut<Walk>;

/// Regions that are handed out together. Jobs look through these for their share, where each would have to walk the whole grid.
class region_batch {
  public:
    void add(texel_rect r) noexcept { regions_[static_cast<std::size_t>(count_++)] = r; }
    void forget() noexcept { count_ = 0; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    [[nodiscard]] bool full() const noexcept { return count_ == most; }
    template <typename F> void operator()(F&& f) const {
        for (int i = 0; i < count_; ++i) f(regions_[static_cast<std::size_t>(i)]);
    }

  private:
    static constexpr int most = 512;
    texel_rect regions_[static_cast<std::size_t>(most)];
    int count_ = 0;
};

} // namespace detail

/// Calls work(y0, y1) for disjoint bands of rows that make up [0, rows), `most` of them, as jobs of an executor: for loops of your own.
template <typename On, typename Work> void in_bands(On&& on, int rows, Work&& work, int most = 64) {
    static_assert(detail::executor_is_callable<On>());
    const int bands = lesser(greater(most, 1), rows);
    const auto begin = [rows, bands](int band) { return static_cast<int>(std::int64_t{rows} * band / bands); };
    if (bands > 0) on(bands, [&work, begin](int band) { work(begin(band), begin(band + 1)); });
}

/// Filters a region as jobs of an executor, as many as there is scratch for: the bits of filter_region.
template <kernel Kernel, texel_format Texel, backend_for<Texel, Kernel> Backend, typename On>
void filter(const Backend& run, std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, texel_rect region,
            band_scratch<Texel, Kernel>& scratch, On&& on) {
    static_assert(detail::executor_is_callable<On>());
    region = clip(clip(region, to.size()), from.size());
    if (region.empty()) return;
    const auto walk = [region](auto&& f) { f(region); };
    const detail::band_cut cut(walk, scratch.size(), detail::least_band<Backend, Kernel, Texel>(region.width()));
    on(cut.size(), [&](int band) { cut.for_each(band, [&](texel_rect r) { run.filter_region(from, to, r, scratch[band]); }); });
}

/// The next frame: filters what `now` marks into an image that holds what `before` marked, and clears what that leaves behind. The
/// executor is called once, for each 512 regions of a scattered frame, and not at all for an empty one.
/// If `now` has another size or tile, all of the map is filtered, unless one of the two marks nothing.
template <kernel Kernel, texel_format Texel, backend_for<Texel, Kernel> Backend, typename On>
void refilter(const Backend& run, std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, const tile_grid& before,
              const tile_grid& now, band_scratch<Texel, Kernel>& scratch, On&& on) {
    static_assert(detail::executor_is_callable<On>());
    GNOMON_ASSERT(now.size().empty() || (now.size() == from.size() && now.size() == to.size()),
                  "gnomon: the tile grid and both images must have the same size: make all three from one extent");
    const bool comparable = same_tiles(before, now) || before.empty() || now.empty();
    const regions_to_filter<Kernel> needed(now, !comparable, detail::sums_run<Backend, Kernel, Texel>);
    detail::region_batch to_clear, to_filter;
    const auto hand_out = [&] {
        const detail::band_cut cleared(to_clear, scratch.size());
        const detail::band_cut filtered(to_filter, scratch.size(), detail::least_band<Backend, Kernel, Texel>(to.width()));
        on(greater(cleared.size(), filtered.size()), [&](int band) {
            cleared.for_each(band, [&](texel_rect r) { clear_region(to, r); });
            filtered.for_each(band, [&](texel_rect r) { run.filter_region(from, to, r, scratch[band]); });
        });
        to_clear.forget();
        to_filter.forget();
    };
    const auto into = [&hand_out](detail::region_batch& batch) {
        return [&](texel_rect r) {
            batch.add(r);
            if (batch.full()) hand_out();
        };
    };
    if (!needed.all()) for_each_region_left(before, now, Kernel::radius, into(to_clear));
    needed(into(to_filter));
    if (!to_clear.empty() || !to_filter.empty()) hand_out();
}

/// Filters what the grid marks as jobs of an executor: the bits of the same call without one.
template <kernel Kernel, texel_format Texel, backend_for<Texel, Kernel> Backend, typename On>
void filter(const Backend& run, std::type_identity_t<image_view<const Texel>> from, image_view<Texel> to, const tile_grid& tiles,
            band_scratch<Texel, Kernel>& scratch, On&& on) {
    refilter(run, from, to, tile_grid{}, tiles, scratch, on);
}

/// A whole image of receivers, one to one on the texels of the map, as jobs of an executor; what the three images share is written.
template <typename T, typename Z, typename Intensity, typename Backend, typename On>
    requires receives<Backend, std::remove_const_t<T>>
void receive(const Backend& run, image_view<T> map, image_view<Z> z, image_view<Intensity> intensity, const rule& r, On&& on) {
    static_assert(detail::executor_is_callable<On>());
    in_bands(on, lesser(map.height(), lesser(z.height(), intensity.height())), [&](int y0, int y1) {
        for (int y = y0; y < y1; ++y) gnomon::receive(run, map.row_span(y), z.row_span(y), intensity.row_span(y), r);
    });
}

} // namespace gnomon::inline GNOMON_BUILD
