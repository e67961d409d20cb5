// gnomon: soft shadow maps. What the rasteriser in lanes is asked to do, in plain numbers and functions of the caller's.
#pragma once

#include <gnomon/geometry/rasterize.hpp>

namespace gnomon::inline GNOMON_BUILD::detail {

/// Depths come in pieces of at most so many of one row.
inline constexpr int row_piece = 256;

/// One mesh for one map. What is called is called by its address, so that nothing of it is compiled for the lanes' processor, where
/// its sums would be rounded otherwise.
struct raster_job {
    const triangle_mesh* mesh;
    const light_frame* light;
    glm::dmat4 to_map;
    double handedness;
    bool perspective;     ///< of the light
    bool divides;         ///< by W, which is not 1
    double near_w, per_w; ///< of a triangle_depth
    texel_rect target;
    faces side;

    /// Takes the depths of a piece of a row; as many more as there are lanes can be read.
    void (*row)(void* rows, int y, int x0, int x1, const float* z);
    void* rows;
    bool (*touches)(const void* where, texel_rect around); ///< null: always
    const void* where;
    void (*mark)(void* marks, texel_rect texels, depth_interval depth); ///< null: nobody is told
    void* marks;
    /// Draws a triangle that planes may cut.
    void (*cut)(const raster_job& job, int first, touched_texels& touched);
    /// Draws a run in lanes.
    void (*run)(const raster_job& job, const triangle_depth& depth, int y, int x0, int x1, touched_texels& touched);

    [[nodiscard]] bool operator()(texel_rect around) const { return touches == nullptr || touches(where, around); }
    [[nodiscard]] bool takes_part(texel_rect around, double area) const { return (*this)(around) && shows(area, handedness, side); }
};

/// A map that rows go to, and the caster of which they are the depths.
template <typename Texel> struct texel_target {
    image_view<Texel> texels;
    Texel caster;
};

} // namespace gnomon::inline GNOMON_BUILD::detail
