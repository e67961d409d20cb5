// gnomon: soft shadow maps. The rasteriser in lanes, second part: rows are drawn, a lane for each column. Included after raster_batch.hpp
// and in its way.

#include <gnomon/geometry/raster_job.hpp>
#include <gnomon/simd/region.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

template <typename Isa> struct rasterizer {
    using triangles = triangle_setup<Isa>;
    using batch = typename triangles::batch;
    using numbers = typename triangles::numbers;
    using doubles = typename Isa::doubles;
    using job = detail::raster_job;
    static constexpr int lanes = Isa::double_lanes;

    /// detail::triangle_depth for as many columns as there are lanes.
    struct depths {
        doubles a, x, b, y, c, nearest, farthest, near_w, per_w, from_0;
        bool inverse;

        /// `saturated`: limited to [0, 1] too.
        GNOMON_LANES depths of(const detail::triangle_depth& d, bool saturated) noexcept {
            const auto limit = [saturated](double v) { return Isa::repeat(saturated ? saturate(v) : v); };
            return {Isa::repeat(d.a),     Isa::repeat(d.x), Isa::repeat(d.b),  Isa::repeat(d.y),
                    Isa::repeat(d.c),     limit(d.nearest), limit(d.farthest), Isa::repeat(d.near_w),
                    Isa::repeat(d.per_w), counted(),        d.inverse};
        }
        /// What does not change along a row, for rows with centres `y`.
        GNOMON_LANES doubles on_rows(const depths& d, doubles y) noexcept {
            return Isa::add(triangles::times(d.b, Isa::subtract(y, d.y)), d.c);
        }
        /// At columns with these centres.
        GNOMON_LANES doubles put(float* to, const depths& d, doubles on_row, doubles centres) noexcept {
            doubles z = Isa::add(triangles::times(d.a, Isa::subtract(centres, d.x)), on_row);
            if (d.inverse) // what is not positive is made so, and comes to be farthest
                z = triangles::times(Isa::subtract(Isa::divide(Isa::repeat(1.0), Isa::larger(z, Isa::repeat(0x1p-1022))), d.near_w),
                                     d.per_w);
            return Isa::store_floats(to, Isa::smaller(Isa::larger(z, d.nearest), d.farthest));
        }
    };
    GNOMON_LANES doubles counted() noexcept {
        numbers n;
        for (int i = 0; i < lanes; ++i) n.lane[i] = i;
        return Isa::load(n.lane);
    }

    /// A piece of a row, whose depths go to `z` too.
    template <typename Row>
    GNOMON_LANES_VOID void draw_piece(const job& j, const depths& d, doubles on_row, int y, int x0, int x1, float* z,
                                      detail::touched_texels& touched) {
        Row row(j, y, x0);
        doubles centres = Isa::add(d.from_0, Isa::repeat(static_cast<double>(x0) + 0.5));
        for (int i = 0; i < x1 - x0; i += lanes) {
            Row::take(row, i, x1 - x0 - i, depths::put(z + i, d, on_row, centres));
            centres = Isa::add(centres, triangles::whole_number(lanes));
        }
        row.finish(y, x0, x1, z);
        touched.add(y, x0, x1, z[0], z[x1 - x0 - 1]);
    }

    template <typename Row>
    GNOMON_LANES_VOID void draw_row(const job& j, const depths& d, doubles on_row, int y, int x0, int x1, float* z,
                                    detail::touched_texels& touched) {
        const int piece = j.touches == nullptr ? detail::row_piece : detail::looked_up;
        for (int x = x0, end; x < x1; x = end) {
            end = lesser(x1, x + piece);
            if (j({x, y, end, y + 1})) draw_piece<Row>(j, d, on_row, y, x, end, z, touched);
        }
    }

    template <typename Row>
    static void draw_run(const job& j, const detail::triangle_depth& depth, int y, int x0, int x1,
                         detail::touched_texels& touched) {
        float z[static_cast<std::size_t>(detail::row_piece + lanes)];
        const depths d = depths::of(depth, Row::saturated);
        draw_row<Row>(j, d, depths::on_rows(d, Isa::repeat(static_cast<double>(y) + 0.5)), y, x0, x1, z, touched);
    }

    /// `LookedUp`: by pieces of runs.
    template <typename Row, bool LookedUp>
    static void draw_few(const batch& b, const job& j, int k, const texel_rect& around, detail::touched_texels& touched) {
        const depths d = depths::of(triangles::depth_of(b, j, k), Row::saturated);
        detail::touched_texels here = touched;
        float z[static_cast<std::size_t>(detail::row_piece + lanes)];
        for (int i = 0; i < around.height(); ++i) {
            const int begin = static_cast<int>(b.begin[i].lane[k]), end = static_cast<int>(b.end[i].lane[k]);
            if (begin >= end) continue;
            const doubles on_row = Isa::repeat(b.on_row[i].lane[k]);
            if constexpr (!LookedUp)
                draw_piece<Row>(j, d, on_row, around.y0 + i, around.x0 + begin, around.x0 + end, z, here);
            else
                draw_row<Row>(j, d, on_row, around.y0 + i, around.x0 + begin, around.x0 + end, z, here);
        }
        touched = here;
    }

    template <typename Row>
    static void draw_rows(const batch& b, const job& j, int k, const texel_rect& around, detail::touched_texels& touched) {
        const depths d = depths::of(triangles::depth_of(b, j, k), Row::saturated);
        detail::touched_texels here = touched;
        float z[static_cast<std::size_t>(detail::row_piece + lanes)];
        for (int first = 0; first < around.height(); first += lanes) { // as many rows as there are lanes
            const doubles rows = Isa::add(d.from_0, triangles::whole_number(first));
            doubles begin = Isa::repeat(0.0), end = triangles::whole_number(around.width());
            for (int i = 0; i < 3; ++i) {
                const auto of = [k](const numbers& n) { return Isa::repeat(n.lane[k]); };
                triangles::cut_rows(begin, end, Isa::add(of(b.edge[i]), Isa::multiply(rows, of(b.per_row[i]))), of(b.per_edge[i]),
                                    of(b.limit[i]));
            }
            numbers from, to, on_row;
            triangles::keep(from, begin);
            triangles::keep(to, end);
            triangles::keep(on_row, depths::on_rows(d, Isa::add(rows, Isa::repeat(static_cast<double>(around.y0) + 0.5))));
            const int count = lesser(lanes, around.height() - first);
            for (int i = 0; i < count; ++i)
                draw_row<Row>(j, d, Isa::repeat(on_row.lane[i]), around.y0 + first + i, around.x0 + static_cast<int>(from.lane[i]),
                              around.x0 + static_cast<int>(to.lane[i]), z, here);
        }
        touched = here;
    }

    template <typename Row>
    GNOMON_LANES_VOID void draw_one(const batch& b, const job& j, int k, int first, detail::touched_texels& touched) {
        const auto has = [k](std::uint32_t bits) { return (bits >> k & 1) != 0; };
        if (!has(b.plain)) return j.cut(j, first + 3 * k, touched);
        const texel_rect around = triangles::box_of(b, k);
        if (!j.takes_part(around, b.area.lane[k])) return;
        if (has(b.few) && j.touches == nullptr)
            draw_few<Row, false>(b, j, k, around, touched);
        else if (has(b.few))
            draw_few<Row, true>(b, j, k, around, touched);
        else
            draw_rows<Row>(b, j, k, around, touched);
    }

    template <typename Row> static void draw(const batch& b, const job& j, int first, detail::touched_texels& touched) {
        for (std::uint32_t left = b.drawn; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            if (j.mark == nullptr) {
                draw_one<Row>(b, j, k, first, touched);
                continue;
            }
            detail::touched_texels here;
            draw_one<Row>(b, j, k, first, here);
            if (here.box.empty()) continue;
            const light_footprint covered = here.footprint();
            j.mark(j.marks, covered.texels, covered.depth);
            touched.add(here);
        }
    }

    template <typename Row> static light_footprint run(const job& j) {
        detail::touched_texels touched;
        batch b;
        const int size = j.mesh->indices.size();
        for (int first = 0; first < size; first += lesser(3 * lanes, size - first)) {
            triangles::fill(b, *j.mesh, first);
            triangles::set_up(b, j);
            draw<Row>(b, j, first, touched);
        }
        return touched.footprint();
    }
};

/// What takes the depths of a piece of a row: registers of them by `take`, `left` columns from there on; then the whole by `finish`.
/// Here, the caller's function.
template <typename Isa> struct called_row {
    static constexpr bool saturated = false;
    const detail::raster_job& job;

    called_row(const detail::raster_job& j, int, int) noexcept : job(j) {}
    GNOMON_LANES_VOID void take(called_row&, int, int, typename Isa::doubles) noexcept {}
    void finish(int y, int x0, int x1, const float* z) const { job.row(job.rows, y, x0, x1, z); }
};

/// Depths as texels store them.
template <typename Isa, texel_format Texel> struct encoded {
    using channel_type = typename Texel::channel_type;
    using doubles = typename Isa::doubles;

    /// depth_mask::encode, in lanes, of depths in [0, 1]: whole codes are still to be rounded down.
    GNOMON_LANES doubles of(doubles z) noexcept {
        const doubles code = Isa::subtract(Isa::repeat(1.0), z);
        if constexpr (channel_type::whole_codes) {
            doubles scaled = Isa::multiply(code, Isa::repeat(static_cast<double>(channel_type::scale)));
            Isa::settle(scaled);
            return Isa::add(scaled, Isa::repeat(0.5));
        } else {
            return code;
        }
    }
};

/// Casts into texels: those of a depth and a mask of whole codes in lanes, others one by one.
template <typename Isa, texel_format Texel> struct cast_row {
    using channel_type = typename Texel::channel_type;
    static constexpr bool saturated = true;
    static constexpr bool pairs = Texel::channels == 2 && channel_type::whole_codes;

    const Texel& caster;
    Texel* row;
    typename Texel::storage code[pairs ? 1 : static_cast<std::size_t>(detail::row_piece + Isa::double_lanes)];

    cast_row(const detail::raster_job& j, int y, int x0) noexcept
        : caster(static_cast<const detail::texel_target<Texel>*>(j.rows)->caster),
          row(static_cast<const detail::texel_target<Texel>*>(j.rows)->texels.row(y) + x0) {}
    GNOMON_LANES_VOID void take(cast_row& to, int i, int left, typename Isa::doubles z) noexcept {
        const auto codes = encoded<Isa, Texel>::of(z);
        if constexpr (pairs)
            Isa::template cast_pairs<channel_type>(
                to.row[i].stored, left < Isa::double_lanes ? (1u << left) - 1 : ~0u >> (32 - Isa::double_lanes), codes);
        else
            Isa::template store_codes<channel_type>(to.code + i, codes);
    }
    void finish(int, int x0, int x1, const float*) const noexcept {
        if constexpr (!pairs) {
            Texel here = caster;
            for (int i = 0; i < x1 - x0; ++i) {
                here.stored[Texel::depth_index] = code[i];
                row[i].cast(here);
            }
        }
    }
};

/// Ends the shadows of texels.
template <typename Isa, texel_format Texel> struct bound_row {
    using representation_type = typename Texel::representation_type;
    static constexpr bool saturated = false; // before the near plane nothing is bounded

    Texel* row;
    typename Texel::storage code[static_cast<std::size_t>(detail::row_piece + Isa::double_lanes)];

    bound_row(const detail::raster_job& j, int y, int x0) noexcept
        : row(static_cast<const detail::texel_target<Texel>*>(j.rows)->texels.row(y) + x0) {}
    GNOMON_LANES_VOID void take(bound_row& to, int i, int, typename Isa::doubles z) noexcept {
        const auto in_range = Isa::smaller(Isa::larger(z, Isa::repeat(0.0)), Isa::repeat(1.0));
        Isa::template store_codes<typename Texel::channel_type>(to.code + i, encoded<Isa, Texel>::of(in_range));
    }
    void finish(int, int x0, int x1, const float* z) const noexcept {
        for (int i = 0; i < x1 - x0; ++i)
            if (z[i] >= 0.0f && !representation_type::nearer(code[i], row[i].stored[Texel::depth_index]) &&
                representation_type::nearer(code[i], row[i].stored[Texel::far_index]))
                row[i].stored[Texel::far_index] = code[i];
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
