// gallery: how far an answer is from the truth.
#pragma once

#include <vector>

namespace gallery {

struct score {
    double rmse = 0.0;
    double max_error = 0.0;
    double false_shadow = 0.0; ///< share of receivers with truth <= .5/255 and estimate > 2/255
    double false_light = 0.0;  ///< share of receivers with truth >= .5 and estimate < truth - .25
};

/// Over all receivers of a view; both lists of intensities are theirs. All zero without any.
[[nodiscard]] score compare(const std::vector<float>& estimate, const std::vector<float>& truth);

/// By how much to multiply differences in a picture: the power of two, 1 to 64, that brings their RMSE up to about 1/4.
[[nodiscard]] int amplification(double rmse);

} // namespace gallery
