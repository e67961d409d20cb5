// gnomon: soft shadow maps. The rasteriser in lanes, first part: triangles are set up, a lane for each. geometry/rasterize_lanes.hpp
// includes it once for each target, inside its region, so there is no #pragma once: GNOMON_ON names the namespace it goes to; without
// it there is nothing.
//
// Every formula is that of geometry/triangle.hpp and GLM, in their order, each product rounded by itself: `times` keeps compilers from
// fusing it with a sum. Products without it are exact. No other number is computed in a region, where a compiler would fuse it.

#include <gnomon/geometry/raster_job.hpp>
#include <gnomon/simd/region.hpp>

#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::inline GNOMON_BUILD::GNOMON_ON {

/// Sets up as many triangles as there are lanes.
template <typename Isa> struct triangle_setup {
    using doubles = typename Isa::doubles;
    using job = detail::raster_job;
    static constexpr int lanes = Isa::double_lanes;
    static_assert(lanes <= 32, "gnomon: the rasteriser keeps a bit for each lane in 32: lanes of up to 256 bytes fit");
    /// Triangles up to so many columns and rows are cut into runs in lanes; larger ones, as those that planes cut, by detail::scan.
    static constexpr double most = 4096.0;
    /// Up to so many rows, of one piece each, they are cut in lanes of triangles.
    static constexpr int few_rows = 32;

    /// A vector or a point of as many triangles as there are lanes.
    struct vectors {
        doubles x, y, z;
    };
    struct numbers {
        double lane[static_cast<std::size_t>(lanes)];
    };

    /// As many triangles as there are lanes, set up. The numbers of one are side by side with those of the others.
    struct batch {
        float position[9][static_cast<std::size_t>(lanes)]{};
        std::uint32_t here = 0;  ///< which lanes hold a triangle of the mesh
        std::uint32_t drawn = 0; ///< which of them hold a centre of the target in the box around them, or may do
        std::uint32_t plain = 0; ///< which are cut by no plane, not too large, and not seen edge-on
        std::uint32_t few = 0;   ///< which have few rows, of one piece each
        numbers x0, y0, x1, y1;  ///< the centres in the box around them, of the target
        numbers edge[3], per_row[3], per_edge[3], limit[3];
        numbers x, y, a, b, c, nearest, farthest, area;
        numbers begin[few_rows], end[few_rows], on_row[few_rows]; ///< of triangles with few rows
    };

    GNOMON_LANES doubles times(doubles a, doubles b) noexcept {
        doubles product = Isa::multiply(a, b);
        Isa::settle(product);
        return product;
    }
    GNOMON_LANES doubles absolute(doubles a) noexcept { return Isa::larger(a, Isa::subtract(Isa::repeat(0.0), a)); }
    GNOMON_LANES doubles whole_number(int v) noexcept { return Isa::repeat(static_cast<double>(v)); }
    GNOMON_LANES doubles sum(doubles a, doubles b, doubles c) noexcept { return Isa::add(Isa::add(a, b), c); }
    GNOMON_LANES doubles cross(doubles a, doubles b, doubles c, doubles d) noexcept {
        return Isa::subtract(times(a, b), times(c, d));
    }
    GNOMON_LANES vectors cross(vectors a, vectors b) noexcept {
        return {cross(a.y, b.z, b.y, a.z), cross(a.z, b.x, b.z, a.x), cross(a.x, b.y, b.x, a.y)};
    }
    GNOMON_LANES_VOID void keep(numbers& to, doubles a) noexcept { Isa::store(to.lane, a); }

    struct projected {
        doubles x, y, z, w;
    };
    GNOMON_LANES projected project(const batch& of, const job& j, int corner) noexcept {
        const doubles px = Isa::template codes<float32>(of.position[3 * corner]),
                      py = Isa::template codes<float32>(of.position[3 * corner + 1]),
                      pz = Isa::template codes<float32>(of.position[3 * corner + 2]);
        const auto row = [&](int r) {
            const auto m = [&](int column) { return Isa::repeat(j.to_map[column][r]); };
            return Isa::add(Isa::add(times(m(0), px), times(m(1), py)), Isa::add(times(m(2), pz), m(3)));
        };
        return {row(0), row(1), row(2), j.divides ? row(3) : Isa::repeat(1.0)};
    }

    /// Which triangles have a corner that a plane cuts off, or may do, for it is not within half the reach; or with a NaN.
    GNOMON_LANES std::uint32_t may_be_cut(const projected& h, const job& j) noexcept {
        const doubles zero = Isa::repeat(0.0), within = Isa::multiply(h.w, Isa::repeat(detail::fixed_point::reach));
        const doubles left = Isa::subtract(Isa::subtract(within, absolute(h.x)), Isa::add(absolute(h.y), Isa::multiply(h.z, zero)));
        return ~(Isa::greater_bits(left, zero) & (j.perspective ? Isa::greater_bits(h.z, zero) : ~0u));
    }

    /// detail::fixed_point::nearest, of what is within its reach.
    GNOMON_LANES doubles snapped(doubles v) noexcept {
        constexpr double bias = 1 << 30, one = static_cast<double>(detail::fixed_point::one);
        const doubles up = Isa::add(Isa::multiply(v, Isa::repeat(one)), Isa::repeat(bias + 0.5));
        return Isa::subtract(Isa::truncate(up), Isa::repeat(bias));
    }
    /// detail::first_centre.
    GNOMON_LANES doubles first_centre(doubles v) noexcept {
        constexpr double bias = 1 << 30, one = static_cast<double>(detail::fixed_point::one);
        const doubles up = Isa::add(v, Isa::repeat(bias + one - 1.0 - static_cast<double>(detail::fixed_point::half)));
        return Isa::subtract(Isa::truncate(Isa::multiply(up, Isa::repeat(1.0 / one))), Isa::repeat(bias / one));
    }

    /// The edges, as `cut_rows` wants them. All but the inverse are whole numbers, and exact.
    ///
    /// dx (y - a.y) - dy (x - a.x) is positive on the inner side; it is kept for the first centre of the box, and for a row more. Times
    /// 1 / 256 dy that is the column where the edge is met, and where a row begins or ends, as the sign of dy says. If dy = 0 it bounds no
    /// row: the column is 0, and no end.
    GNOMON_LANES_VOID void set_up_edges(batch& b, const doubles (&x)[3], const doubles (&y)[3]) noexcept {
        const doubles zero = Isa::repeat(0.0), one = Isa::repeat(1.0), texel = Isa::repeat(256.0), half = Isa::repeat(128.0);
        const doubles turn = Isa::subtract(Isa::multiply(Isa::subtract(x[1], x[0]), Isa::subtract(y[2], y[0])),
                                           Isa::multiply(Isa::subtract(y[1], y[0]), Isa::subtract(x[2], x[0])));
        const doubles sign = Isa::smaller(Isa::larger(turn, Isa::repeat(-1.0)), one);
        const doubles centre_x = Isa::add(Isa::multiply(Isa::load(b.x0.lane), texel), half),
                      centre_y = Isa::add(Isa::multiply(Isa::load(b.y0.lane), texel), half);
        for (int i = 0; i < 3; ++i) {
            const int next = i < 2 ? i + 1 : 0;
            const doubles dx = Isa::multiply(Isa::subtract(x[next], x[i]), sign),
                          dy = Isa::multiply(Isa::subtract(y[next], y[i]), sign), per_column = Isa::multiply(dy, texel);
            keep(b.edge[i],
                 Isa::subtract(Isa::multiply(dx, Isa::subtract(centre_y, y[i])), Isa::multiply(dy, Isa::subtract(centre_x, x[i]))));
            keep(b.per_row[i], Isa::multiply(dx, texel));
            keep(b.per_edge[i], Isa::divide(per_column, Isa::larger(Isa::multiply(per_column, per_column), one))); // 0 for 0
            keep(b.limit[i], beyond(Isa::subtract(Isa::repeat(0.5), dy)));
        }
        b.drawn &= ~b.plain | Isa::greater_bits(turn, zero) | Isa::greater_bits(zero, turn); // else there is no centre in it
    }
    /// Beyond all columns, on the side of the sign of `a`, half a whole number.
    GNOMON_LANES doubles beyond(doubles a) noexcept {
        return Isa::smaller(Isa::larger(Isa::multiply(a, Isa::repeat(4.0 * most)), Isa::repeat(-2.0 * most)),
                            Isa::repeat(2.0 * most));
    }

    /// detail::depth_surface.
    GNOMON_LANES_VOID void set_up_depth(batch& b, const projected (&h)[3], const doubles& x, const doubles& y,
                                        const job& j) noexcept {
        const doubles one = Isa::repeat(1.0);
        const doubles c = j.perspective ? Isa::divide(one, h[0].w) : h[0].z;
        vectors u[3];
        doubles rest[3];
        for (int i = 0; i < 3; ++i) {
            u[i] = {Isa::subtract(h[i].x, times(x, h[i].w)), Isa::subtract(h[i].y, times(y, h[i].w)), h[i].w};
            rest[i] = Isa::subtract(j.perspective ? one : h[i].z, times(c, h[i].w));
        }
        const vectors u01 = cross(u[0], u[1]), u12 = cross(u[1], u[2]), u20 = cross(u[2], u[0]);
        const doubles area = sum(times(u[0].x, u12.x), times(u[0].y, u12.y), times(u[0].z, u12.z));
        const auto solved = [&](const doubles& p, const doubles& q, const doubles& r) {
            return Isa::divide(sum(times(rest[0], p), times(rest[1], q), times(rest[2], r)), area);
        };
        keep(b.x, x);
        keep(b.y, y);
        keep(b.a, solved(u12.x, u20.x, u01.x));
        keep(b.b, solved(u12.y, u20.y, u01.y));
        keep(b.c, Isa::add(c, solved(u12.z, u20.z, u01.z)));
        keep(b.nearest, Isa::smaller(h[2].z, Isa::smaller(h[1].z, h[0].z)));
        keep(b.farthest, Isa::larger(h[2].z, Isa::larger(h[1].z, h[0].z)));
        keep(b.area, area);
        b.plain &= Isa::greater_bits(area, Isa::repeat(0.0)) | Isa::greater_bits(Isa::repeat(0.0), area);
    }

    /// Cuts rows of a box by an edge. The edge names one column on every row, the first whose centre is not left of it: see scan.hpp.
    /// Where it is met is a fraction of 256 dy: on a whole column, or at least 2^-29 after it. The product is within 2^-40 of that, which
    /// the rounding of a number near 16384, to 2^-39, takes away; so it is rounded up rightly.
    /// `limit` says which side it bounds: beyond all columns before, it is the end, beyond them behind, the beginning.
    GNOMON_LANES_VOID void cut_rows(doubles& begin, doubles& end, doubles edge, doubles per_edge, doubles limit) noexcept {
        constexpr double bias = 4.0 * most;
        const doubles met = Isa::smaller(Isa::larger(Isa::multiply(edge, per_edge), Isa::repeat(-1.0)), Isa::repeat(2.0 * most));
        const doubles column = Isa::subtract(Isa::repeat(bias), Isa::truncate(Isa::subtract(Isa::repeat(bias), met)));
        begin = Isa::larger(begin, Isa::smaller(column, limit));
        end = Isa::smaller(end, Isa::larger(column, limit));
    }

    /// The rows of triangles that have few.
    static void set_up_rows(batch& b) noexcept {
        const doubles y0 = Isa::load(b.y0.lane), height = Isa::subtract(Isa::load(b.y1.lane), y0);
        const doubles width = Isa::subtract(Isa::load(b.x1.lane), Isa::load(b.x0.lane));
        b.few =
            Isa::greater_bits(Isa::repeat(few_rows + 0.5), height) & Isa::greater_bits(Isa::repeat(detail::row_piece + 0.5), width);
        const std::uint32_t rows_of = b.few & b.plain & b.drawn;
        for (int row = 0; row < few_rows && (Isa::greater_bits(height, whole_number(row)) & rows_of) != 0; ++row) {
            doubles begin = Isa::repeat(0.0), end = width;
            for (int i = 0; i < 3; ++i)
                cut_rows(begin, end,
                         Isa::add(Isa::load(b.edge[i].lane), Isa::multiply(Isa::load(b.per_row[i].lane), whole_number(row))),
                         Isa::load(b.per_edge[i].lane), Isa::load(b.limit[i].lane));
            keep(b.begin[row], begin);
            keep(b.end[row], end);
            const doubles centres = Isa::add(y0, Isa::repeat(static_cast<double>(row) + 0.5));
            keep(b.on_row[row],
                 Isa::add(times(Isa::load(b.b.lane), Isa::subtract(centres, Isa::load(b.y.lane))), Isa::load(b.c.lane)));
        }
    }

    static void set_up(batch& b, const job& j) noexcept {
        const projected h[3] = {project(b, j, 0), project(b, j, 1), project(b, j, 2)};
        const std::uint32_t uncut = ~(may_be_cut(h[0], j) | may_be_cut(h[1], j) | may_be_cut(h[2], j));
        b.plain = uncut;

        doubles map_x[3], map_y[3], x[3], y[3];
        for (int i = 0; i < 3; ++i) {
            map_x[i] = j.divides ? Isa::divide(h[i].x, h[i].w) : h[i].x;
            map_y[i] = j.divides ? Isa::divide(h[i].y, h[i].w) : h[i].y;
            // What is cut is drawn elsewhere; here it must only be a number.
            const doubles reach = Isa::repeat(detail::fixed_point::reach), before = Isa::repeat(-detail::fixed_point::reach);
            x[i] = snapped(Isa::smaller(Isa::larger(map_x[i], before), reach));
            y[i] = snapped(Isa::smaller(Isa::larger(map_y[i], before), reach));
        }
        const doubles left = first_centre(Isa::smaller(Isa::smaller(x[0], x[1]), x[2])),
                      right = first_centre(Isa::larger(Isa::larger(x[0], x[1]), x[2])),
                      top = first_centre(Isa::smaller(Isa::smaller(y[0], y[1]), y[2])),
                      bottom = first_centre(Isa::larger(Isa::larger(y[0], y[1]), y[2]));
        const doubles x0 = Isa::larger(left, whole_number(j.target.x0)), x1 = Isa::smaller(right, whole_number(j.target.x1));
        const doubles y0 = Isa::larger(top, whole_number(j.target.y0)), y1 = Isa::smaller(bottom, whole_number(j.target.y1));
        keep(b.x0, x0);
        keep(b.x1, x1);
        keep(b.y0, y0);
        keep(b.y1, y1);
        b.drawn = Isa::greater_bits(x1, x0) & Isa::greater_bits(y1, y0);
        b.plain &= Isa::greater_bits(Isa::repeat(most), Isa::subtract(right, left)) &
                   Isa::greater_bits(Isa::repeat(most), Isa::subtract(bottom, top));
        if ((b.plain & b.drawn & b.here) != 0) {
            set_up_edges(b, x, y);
            set_up_depth(b, h, map_x[0], map_y[0], j);
            set_up_rows(b);
        }
        b.drawn = (b.drawn | ~uncut) & b.here;
    }

    static void fill(batch& b, const triangle_mesh& mesh, int first) noexcept {
        b.here = 0;
        const auto positions = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < lanes && 3 * k + 2 < mesh.indices.size() - first; ++k) {
            std::uint32_t index[3];
            bool known = true;
            for (int i = 0; i < 3; ++i) known = (index[i] = mesh.indices[first + 3 * k + i]) < positions && known;
            if (!known) continue;
            b.here |= 1u << k;
            for (int i = 0; i < 3; ++i) {
                const auto& p = mesh.positions[static_cast<int>(index[i])];
                b.position[3 * i][k] = p.x;
                b.position[3 * i + 1][k] = p.y;
                b.position[3 * i + 2][k] = p.z;
            }
        }
    }

    [[nodiscard]] static detail::triangle_depth depth_of(const batch& b, const job& j, int k) noexcept {
        return {j.perspective, j.near_w,    j.per_w,     b.x.lane[k],       b.y.lane[k],
                b.a.lane[k],   b.b.lane[k], b.c.lane[k], b.nearest.lane[k], b.farthest.lane[k]};
    }

    [[nodiscard]] static texel_rect box_of(const batch& b, int k) noexcept {
        const auto as_int = [k](const numbers& n) { return static_cast<int>(n.lane[k]); };
        return {as_int(b.x0), as_int(b.y0), as_int(b.x1), as_int(b.y1)};
    }
};

} // namespace gnomon::inline GNOMON_BUILD::GNOMON_ON
#endif
