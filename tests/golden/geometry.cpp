// From the world to texels and depths, by plain loops and in whichever lanes the processor has.
//
// geometry/ computes in double with GLM, plainly, and here fused multiply-adds do change the last digits of a double. So there are
// two kinds of lines. *exact*: lights, triangles and bounds whose every product and sum has few digits, so that nothing is rounded
// and nothing can differ. *rounded*: any numbers; these lines hold for -ffp-contract=off, with which this file alone is compiled.
//
// Left out is what comes from the functions of the C library that no standard says how to round: tan, exp2, log2 and hypot, with which
// spot_light and directional_light fit their frames.
#include "golden.hpp"

#include "../support/images.hpp"

#include <gnomon/geometry/rasterize.hpp>
#include <gnomon/geometry/rasterize_lanes.hpp>

#include <array>
#include <vector>

namespace golden {
namespace {

/// Numbers for a world. `whole`: multiples of 1/16 that a float holds, below 64; otherwise doubles with all their digits.
struct world_dice {
    test::dice roll;
    bool exact;

    double operator()(double reach) {
        if (exact) return roll(-static_cast<int>(reach) * 16, static_cast<int>(reach) * 16) / 16.0;
        const double v = digits(roll, -30, 0) * reach;
        return roll.one_in(2) ? v : -v;
    }
    glm::dvec3 vector(double reach) {
        const double x = (*this)(reach), y = (*this)(reach), z = (*this)(reach);
        return {x, y, z};
    }
};

constexpr extent size{64, 64};

/// A light that looks down -z, from any angle that `dice` knows: its matrix is not scaled where it has to stay exact.
light_frame any_light(world_dice& dice, bool perspective) {
    glm::dmat4 rows(0.0); // as rows, transposed below
    const double slant = dice.exact ? 0.0 : 1.0;
    const glm::dvec3 x = dice.vector(slant), y = dice.vector(slant), w = dice.vector(slant);
    rows[3] = perspective ? glm::dvec4(w.x * 0.1, w.y * 0.1, -1.0, 64.0) : glm::dvec4(0.0, 0.0, 0.0, 1.0);
    rows[0] = glm::dvec4(1.0 + x.x * 0.1, x.y * 0.1, x.z * 0.1, 0.0) + rows[3] * 32.0;
    rows[1] = glm::dvec4(y.x * 0.1, 1.0 + y.y * 0.1, y.z * 0.1, 0.0) + rows[3] * 32.0;
    if (perspective) { // depth 0 at W = 16, depth 1 at W = 144
        rows[2] = (rows[3] - glm::dvec4(0.0, 0.0, 0.0, 16.0)) / 128.0;
        return {glm::transpose(rows), size, 16.0, 144.0};
    }
    rows[2] = glm::dvec4(0.0, 0.0, -1.0 / 128.0, 0.5);
    return {glm::transpose(rows), size, 1.0, 1.0};
}

hash hash_of(const light_footprint& f) {
    hash h;
    h.add(f.texels, f.depth);
    return h;
}

/// Everything that takes a frame, for 40 lights.
void print_kind(const char* kind, bool exact) {
    hash points, boxes, balls, texels, texels_in_lanes, matrices;
    world_dice dice{test::dice(120), exact};
    for (int i = 0; i < 40; ++i) {
        const bool perspective = !exact && i % 2 != 0; // a divide is exact for powers of two alone
        const light_frame light = any_light(dice, perspective);
        for (int k = 0; k < 100; ++k) {
            const map_point p = light.to_map(dice.vector(40.0));
            points.add(p.x, p.y, p.depth);
            const glm::dvec3 a = dice.vector(40.0), b = dice.vector(9.0);
            boxes.add(hash_of(footprint(bounding_box{a - glm::abs(b), a + glm::abs(b)}, light)).value());
            balls.add(hash_of(footprint(bounding_sphere{a, glm::abs(b).x}, light)).value());
        }
        for (const clip_space clip :
             {clip_space{}, clip_space{clip_depth::zero_to_one, true}, clip_space{clip_depth::one_to_zero, false}}) {
            const glm::dvec3 origin = dice.vector(30.0);
            const glm::mat4 m = light.clip_matrix(clip, origin);
            const light_frame again = light_frame::from_matrix(glm::dmat4(light.clip_matrix(clip)), size, clip);
            const glm::vec4 plane = light.depth_plane(origin);
            for (int c = 0; c < 4; ++c) {
                for (int r = 0; r < 4; ++r) matrices.add(m[c][r], again.matrix()[c][r]);
                matrices.add(plane[c]);
            }
        }
        triangle_mesh mesh{};
        std::vector<glm::vec3> corners;
        std::vector<std::uint32_t> order;
        for (std::uint32_t k = 0; k < 30; ++k) {
            // Where all is to be exact the triangles have right angles with sides of powers of two, for their planes are divisions.
            const glm::dvec3 a = dice.vector(30.0);
            const double side = static_cast<double>(1 << dice.roll(0, 4));
            glm::dvec3 b = a + glm::dvec3(side, 0.0, 4.0), c = a + glm::dvec3(0.0, side, -2.0);
            if (!exact) {
                b = a + dice.vector(20.0);
                c = a + dice.vector(20.0);
            }
            for (const glm::dvec3& corner : {a, b, c}) corners.emplace_back(corner);
            order.insert(order.end(), {3 * k, 3 * k + 1, 3 * k + 2});
        }
        mesh.positions = corners;
        mesh.indices = order;
        const auto draw = [&](auto run, hash& h) {
            h.add(hash_of(rasterize(run, mesh, light, whole(size), faces::both, [&h](int x, int y, float z) {
                      h.add(x, y, z);
                  })).value());
            image<rgba16> map(size, rgba16::clear());
            cast_triangles(run, map.view(), mesh, light, 0.75f, faces::lit_side);
            bound_triangles(run, map.view(), mesh, light, faces::dark_side);
            h.add(test::hash(map));
        };
        draw(scalar{}, texels);
        draw(simd<>{}, texels_in_lanes);
    }
    print("to_map", "geometry", kind, points);
    print("footprint_of_box", "geometry", kind, boxes);
    print("footprint_of_ball", "geometry", kind, balls);
    print("clip_matrix_and_back", "geometry", kind, matrices);
    print("rasterize", "geometry", kind, texels);
    print("rasterize_in_lanes", "geometry", kind, texels_in_lanes); // the number of `rasterize`
}

} // namespace

void print_geometry() {
    print_kind("exact", true);
    print_kind("rounded", false);
}

} // namespace golden
