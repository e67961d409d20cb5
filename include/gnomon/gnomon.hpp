// gnomon: soft shadow maps. All that runs on a CPU without GLM. For meshes and lights add <gnomon/geometry/...>.
#pragma once

#include <gnomon/backend/simd.hpp>
#include <gnomon/filter/pyramid.hpp>
#include <gnomon/grid/reference_grid.hpp>
#include <gnomon/receive/cull.hpp>
#include <gnomon/receive/depth_error.hpp>
#include <gnomon/receive/lightmap.hpp>
#include <gnomon/soft_shadow_map.hpp>
#include <gnomon/texel/depth_shear.hpp>
#include <gnomon/version.hpp>
