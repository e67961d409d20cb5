// gnomon: soft shadow maps. The rasteriser in lanes. geometry/rasterize_lanes.hpp includes it once for each target, inside its region,
// so there is no #pragma once: GNOMON_ON names the namespace it goes to; without it there is nothing.
//
// Lanes are triangles while triangles are set up, and columns while rows are drawn. Every formula is that of geometry/rasterize.hpp
// and GLM, in their order, each product rounded: `settle` keeps compilers from fusing it. No other number is computed in here, for a
// compiler would fuse that.

#include <gnomon/geometry/raster_job.hpp>
#include <gnomon/simd/region.hpp>

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>

#ifdef GNOMON_ON
namespace gnomon::GNOMON_ON {

template <typename Isa> struct rasterizer {
    using doubles = typename Isa::doubles;
    using job = detail::raster_job;
    static constexpr int lanes = Isa::double_lanes;
    /// Triangles up to so many columns and rows are cut into runs in lanes; larger ones, as those that planes cut, by detail::scan.
    static constexpr double most = 4096.0;
    /// Up to so many rows, they are cut in lanes of triangles.
    static constexpr int few_rows = 8;

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
        std::uint32_t few = 0;   ///< which have few rows
        numbers x0, y0, x1, y1;  ///< the centres in the box around them, of the target
        numbers edge[3], per_row[3], per_edge[3], lower_limit[3], upper_limit[3];
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
    /// 1 / 256 dy that is the column where the edge is met. It bounds a row from below or from above, as dy says.
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
            keep(b.lower_limit[i], limit(Isa::subtract(Isa::repeat(-0.5), dy)));
            keep(b.upper_limit[i], limit(Isa::subtract(Isa::repeat(0.5), dy)));
        }
        b.drawn &= ~b.plain | Isa::greater_bits(turn, zero) | Isa::greater_bits(zero, turn); // else there is no centre in it
    }
    /// Beyond all columns, on the side of the sign of `a`, half a whole number.
    GNOMON_LANES doubles limit(doubles a) noexcept {
        const doubles beyond = Isa::repeat(2.0 * most);
        return Isa::smaller(Isa::larger(Isa::multiply(a, Isa::repeat(4.0 * most)), Isa::subtract(Isa::repeat(0.0), beyond)),
                            beyond);
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
    /// Where it is met is a fraction of 256 dy, so it is on a whole column or at least 2^-29 after it; and known to 2^-38, so that less
    /// 2^-30 it is rounded up rightly.
    GNOMON_LANES_VOID void cut_rows(doubles& begin, doubles& end, doubles edge, doubles per_edge, doubles lower_limit,
                                    doubles upper_limit) noexcept {
        constexpr double bias = 4.0 * most;
        const doubles met = Isa::smaller(Isa::larger(Isa::multiply(edge, per_edge), Isa::repeat(-1.0)), Isa::repeat(2.0 * most));
        const doubles column = Isa::subtract(Isa::repeat(bias), Isa::truncate(Isa::subtract(Isa::repeat(bias + 0x1p-30), met)));
        begin = Isa::larger(begin, Isa::smaller(column, lower_limit));
        end = Isa::smaller(end, Isa::larger(column, upper_limit));
    }

    /// The rows of triangles that have few.
    static void set_up_rows(batch& b) noexcept {
        const doubles y0 = Isa::load(b.y0.lane), height = Isa::subtract(Isa::load(b.y1.lane), y0);
        const doubles width = Isa::subtract(Isa::load(b.x1.lane), Isa::load(b.x0.lane));
        b.few = Isa::greater_bits(Isa::repeat(few_rows + 0.5), height);
        const std::uint32_t rows_of = b.few & b.plain & b.drawn;
        for (int row = 0; row < few_rows && (Isa::greater_bits(height, whole_number(row)) & rows_of) != 0; ++row) {
            doubles begin = Isa::repeat(0.0), end = width;
            for (int i = 0; i < 3; ++i)
                cut_rows(begin, end,
                         Isa::add(Isa::load(b.edge[i].lane), Isa::multiply(Isa::load(b.per_row[i].lane), whole_number(row))),
                         Isa::load(b.per_edge[i].lane), Isa::load(b.lower_limit[i].lane), Isa::load(b.upper_limit[i].lane));
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

    [[nodiscard]] static detail::triangle_depth depth_of(const batch& b, const job& j, int k) noexcept {
        return {j.perspective, j.near_w,    j.per_w,     b.x.lane[k],       b.y.lane[k],
                b.a.lane[k],   b.b.lane[k], b.c.lane[k], b.nearest.lane[k], b.farthest.lane[k]};
    }

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
            return Isa::add(times(d.b, Isa::subtract(y, d.y)), d.c);
        }
        /// At columns with these centres.
        GNOMON_LANES doubles put(float* to, const depths& d, doubles on_row, doubles centres) noexcept {
            doubles z = Isa::add(times(d.a, Isa::subtract(centres, d.x)), on_row);
            if (d.inverse) // what is not positive is made so, and comes to be farthest
                z = times(Isa::subtract(Isa::divide(Isa::repeat(1.0), Isa::larger(z, Isa::repeat(0x1p-1022))), d.near_w), d.per_w);
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
            row.take(i, x1 - x0 - i, depths::put(z + i, d, on_row, centres));
            centres = Isa::add(centres, whole_number(lanes));
        }
        row.finish(y, x0, x1, z);
        touched.add(y, x0, x1, z[0], z[x1 - x0 - 1]);
    }

    template <typename Row>
    static void draw_run(const job& j, const detail::triangle_depth& depth, int y, int x0, int x1,
                         detail::touched_texels& touched) {
        constexpr int most = detail::row_piece;
        float z[static_cast<std::size_t>(most + lanes)];
        const depths d = depths::of(depth, Row::saturated);
        const doubles on_row = depths::on_rows(d, Isa::repeat(static_cast<double>(y) + 0.5));
        for (int x = x0; x < x1; x += most) draw_piece<Row>(j, d, on_row, y, x, lesser(x1, x + most), z, touched);
    }

    template <typename Row>
    GNOMON_LANES_VOID void draw_row(const job& j, const depths& d, double on_row, int y, int x0, int x1, float* z,
                                    detail::touched_texels& touched) {
        for (int x = x0; x < x1; x += detail::row_piece)
            draw_piece<Row>(j, d, Isa::repeat(on_row), y, x, lesser(x1, x + detail::row_piece), z, touched);
    }

    template <typename Row>
    static void draw_few(const batch& b, const job& j, int k, const texel_rect& around, detail::touched_texels& touched) {
        const depths d = depths::of(depth_of(b, j, k), Row::saturated);
        detail::touched_texels here = touched;
        float z[static_cast<std::size_t>(detail::row_piece + lanes)];
        for (int i = 0; i < around.height(); ++i)
            draw_row<Row>(j, d, b.on_row[i].lane[k], around.y0 + i, around.x0 + static_cast<int>(b.begin[i].lane[k]),
                          around.x0 + static_cast<int>(b.end[i].lane[k]), z, here);
        touched = here;
    }

    template <typename Row>
    static void draw_rows(const batch& b, const job& j, int k, const texel_rect& around, detail::touched_texels& touched) {
        const depths d = depths::of(depth_of(b, j, k), Row::saturated);
        detail::touched_texels here = touched;
        float z[static_cast<std::size_t>(detail::row_piece + lanes)];
        for (int first = 0; first < around.height(); first += lanes) { // as many rows as there are lanes
            const doubles rows = Isa::add(d.from_0, whole_number(first));
            doubles begin = Isa::repeat(0.0), end = whole_number(around.width());
            for (int i = 0; i < 3; ++i) {
                const auto of = [k](const numbers& n) { return Isa::repeat(n.lane[k]); };
                cut_rows(begin, end, Isa::add(of(b.edge[i]), Isa::multiply(rows, of(b.per_row[i]))), of(b.per_edge[i]),
                         of(b.lower_limit[i]), of(b.upper_limit[i]));
            }
            numbers from, to, on_row;
            keep(from, begin);
            keep(to, end);
            keep(on_row, depths::on_rows(d, Isa::add(rows, Isa::repeat(static_cast<double>(around.y0) + 0.5))));
            const int count = lesser(lanes, around.height() - first);
            for (int i = 0; i < count; ++i)
                draw_row<Row>(j, d, on_row.lane[i], around.y0 + first + i, around.x0 + static_cast<int>(from.lane[i]),
                              around.x0 + static_cast<int>(to.lane[i]), z, here);
        }
        touched = here;
    }

    template <typename Row> static void draw(const batch& b, const job& j, int first, detail::touched_texels& touched) {
        for (std::uint32_t left = b.drawn; left != 0; left &= left - 1) {
            const int k = std::countr_zero(left);
            const auto has = [k](std::uint32_t bits) { return (bits >> k & 1) != 0; };
            if (!has(b.plain)) {
                j.cut(j, first + 3 * k, touched);
                continue;
            }
            const auto as_int = [k](const numbers& n) { return static_cast<int>(n.lane[k]); };
            const texel_rect around{as_int(b.x0), as_int(b.y0), as_int(b.x1), as_int(b.y1)};
            if (!j.takes_part(around, b.area.lane[k])) continue;
            if (has(b.few))
                draw_few<Row>(b, j, k, around, touched);
            else
                draw_rows<Row>(b, j, k, around, touched);
        }
    }

    static void fill(batch& b, const triangle_mesh& mesh, int first) noexcept {
        b.here = 0;
        const auto positions = static_cast<std::uint32_t>(mesh.positions.size());
        for (int k = 0; k < lanes && first + 3 * k + 2 < mesh.indices.size(); ++k) {
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

    template <typename Row> static light_footprint run(const job& j) {
        detail::touched_texels touched;
        batch b;
        for (int first = 0; first + 2 < j.mesh->indices.size(); first += 3 * lanes) {
            fill(b, *j.mesh, first);
            set_up(b, j);
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
    GNOMON_LANES_VOID void take(int, int, typename Isa::doubles) noexcept {}
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
    [[gnu::always_inline]] void take(int i, int left, typename Isa::doubles z) noexcept {
        const auto codes = encoded<Isa, Texel>::of(z);
        if constexpr (pairs)
            Isa::template cast_pairs<channel_type>(
                row[i].stored, left < Isa::double_lanes ? (1u << left) - 1 : ~0u >> (32 - Isa::double_lanes), codes);
        else
            Isa::template store_codes<channel_type>(code + i, codes);
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
    [[gnu::always_inline]] void take(int i, int, typename Isa::doubles z) noexcept {
        const auto in_range = Isa::smaller(Isa::larger(z, Isa::repeat(0.0)), Isa::repeat(1.0));
        Isa::template store_codes<typename Texel::channel_type>(code + i, encoded<Isa, Texel>::of(in_range));
    }
    void finish(int, int x0, int x1, const float* z) const noexcept {
        for (int i = 0; i < x1 - x0; ++i)
            if (z[i] >= 0.0f && !representation_type::nearer(code[i], row[i].stored[Texel::depth_index]) &&
                representation_type::nearer(code[i], row[i].stored[Texel::far_index]))
                row[i].stored[Texel::far_index] = code[i];
    }
};

} // namespace gnomon::GNOMON_ON
#endif
