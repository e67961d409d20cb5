// Lights of either kind, by dice.
#pragma once

#include <gnomon/geometry/directional_light.hpp>
#include <gnomon/geometry/spot_light.hpp>

#include "world_dice.hpp"

namespace test {

/// The i-th of a series, of suns and spots by turns, that sees what is around the origin.
inline gnomon::light_frame any_light(world_dice& roll, int i, gnomon::extent map_size) {
    if (i % 2 == 0) {
        gnomon::directional_light sun(roll.vector(1.0));
        sun.add_caster(gnomon::bounding_sphere{glm::dvec3(0), 6.0});
        return sun.frame(map_size, 2);
    }
    return gnomon::spot_light{.position = roll.vector(4.0),
                              .direction = roll.vector(1.0),
                              .outer_angle = roll(0.3, 1.2),
                              .near_plane = roll(0.2, 2.0),
                              .far_plane = roll(6.0, 20.0)}
        .frame(map_size);
}

} // namespace test
