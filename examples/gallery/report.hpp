// gallery: the table, and what the page says about it.
#pragma once

#include "score.hpp"
#include "soft.hpp"

namespace gallery {

struct measured {
    answer what; ///< without its intensities
    score error;
};

[[nodiscard]] std::string numbers_of(const std::vector<measured>& table, std::size_t receivers); ///< in HTML
[[nodiscard]] std::string csv_head();
[[nodiscard]] std::string csv_of(const std::string& id, const std::vector<measured>& table);
[[nodiscard]] std::string about_the_gallery(const std::string& mesh_name); ///< in HTML

} // namespace gallery
