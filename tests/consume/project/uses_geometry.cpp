// What only gnomon::glm promises: the geometry headers find GLM.
#include <gnomon/geometry/light_frame.hpp>
