// gallery: the contact sheet, the table and the page.
#pragma once

#include "picture.hpp"
#include "score.hpp"
#include "soft.hpp"

namespace gallery {

/// One picture of a row, as it stands on the sheet and on the page.
struct exhibit {
    std::string file;
    std::string caption;       ///< on the page
    std::string short_caption; ///< on the sheet; empty: on the page only
    picture thumbnail;
};

struct measured {
    answer what; ///< without its intensities
    score error;
};

/// All about one variant of a scene.
struct row {
    variant about;
    std::size_t receivers = 0;
    std::vector<exhibit> exhibits;
    std::vector<measured> table;
};

inline constexpr int thumbnail_width = 224, thumbnail_height = 168;

[[nodiscard]] picture contact_sheet(const std::vector<row>& rows);
[[nodiscard]] std::string csv(const std::vector<row>& rows);
[[nodiscard]] std::string html(const std::vector<row>& rows, const std::string& mesh_name);

} // namespace gallery
