// gallery: pictures in rows, as a contact sheet and as a page.
#pragma once

#include "picture.hpp"
#include "scene.hpp"

namespace gallery {

/// One picture of a row, as it stands on the sheet and on the page.
struct exhibit {
    std::string file;
    std::string caption;       ///< on the page
    std::string short_caption; ///< on the sheet; empty: on the page only
    picture thumbnail;
};

/// All about one variant of a scene.
struct row {
    variant about;
    std::vector<exhibit> exhibits;
    std::string numbers; ///< below them on the page, in HTML
};

inline constexpr int thumbnail_width = 224, thumbnail_height = 168;

[[nodiscard]] picture contact_sheet(const std::vector<row>& rows, const std::string& legend);
/// `about` stands on top, in HTML.
[[nodiscard]] std::string html(const std::string& title, const std::string& about, const std::vector<row>& rows);

/// printf into a string of at most 511 characters; `format` is a literal.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);
/// Text as HTML shows it.
[[nodiscard]] std::string escaped(const std::string& plain);

} // namespace gallery
