#include "table.hpp"

#include <gallery/page.hpp>

#include <filesystem>

namespace gl_headless {

using gallery::escaped;
using gallery::formatted;

namespace {
/// "12, 3.1e-05", or "0"
std::string text_of(const differing& d) { return d.count == 0 ? "0" : formatted("%lld, %.1e", d.count, d.largest); }
} // namespace

std::string why(const comparison& c) {
    std::string words;
    const auto add = [&words](bool so, const char* word) {
        if (so) words += (words.empty() ? "" : ", ") + std::string(word);
    };
    add(!c.missing.empty(), "not here");
    add(c.edge_texels > 0, "edges");
    add(c.depths.count + c.bounds.count > 0, "depths");
    add(c.received_alike.count > 0, "last places");
    add(c.filtered_alike > 0, "A FAULT");
    return words;
}

std::string numbers_of(const std::vector<comparison>& table, std::size_t receivers) {
    std::string lines =
        "<table><tr><th>format<th>casters<th>edge texels<th>depths<th>bounds<th>soft texels<th>receivers"
        "<th>soft texels from<br>equal casters<th>receivers on<br>equal soft maps<th>decided<br>otherwise<th>why</tr>\n";
    for (const comparison& c : table) {
        lines += "<tr><td>" + c.name.texel;
        if (!c.missing.empty()) {
            lines += "<td colspan=\"10\">" + escaped(c.missing) + "</tr>\n";
            continue;
        }
        lines +=
            formatted("<td>%lld<td>%lld<td>%s<td>%s<td>%lld<td>%s<td>%lld<td>%s<td>%lld<td>%s</tr>\n", c.casters, c.edge_texels,
                      text_of(c.depths).c_str(), text_of(c.bounds).c_str(), c.filtered, text_of(c.received).c_str(),
                      c.filtered_alike, text_of(c.received_alike).c_str(), c.decided_otherwise, why(c).c_str());
    }
    return lines + "</table>\n" + formatted("<p>%zu receivers.</p>\n", receivers);
}

std::string csv_head() {
    return "scene,format,casters,edge_texels,depths,depths_largest,bounds,bounds_largest,soft,received,received_largest,"
           "soft_from_equal_casters,received_on_equal_soft,received_on_equal_soft_largest,decided_otherwise,why\n";
}

std::string csv_of(const std::string& id, const std::vector<comparison>& table) {
    std::string lines;
    for (const comparison& c : table) {
        std::string words = c.missing.empty() ? why(c) : c.missing;
        for (char& each : words)
            if (each == ',') each = ';';
        lines += formatted("%s,%s,%lld,%lld,%lld,%.3g,%lld,%.3g,%lld,%lld,%.3g,%lld,%lld,%.3g,%lld,", id.c_str(),
                           c.name.texel.c_str(), c.casters, c.edge_texels, c.depths.count, c.depths.largest, c.bounds.count,
                           c.bounds.largest, c.filtered, c.received.count, c.received.largest, c.filtered_alike,
                           c.received_alike.count, c.received_alike.largest, c.decided_otherwise) +
                 words + "\n";
    }
    return lines;
}

std::string about(const std::string& renderer, const std::string& mesh_name) {
    return "<p>Mesh: " + escaped(std::filesystem::path(mesh_name).filename().string()) + ". GL: " + escaped(renderer) +
           formatted(". Shadow map %d x %d, tiles of %d, kernel <code>%s</code>.</p>\n", gallery::map_extent.width,
                     gallery::map_extent.height, gallery::tile_size, escaped(gallery::kernel_name).c_str()) +
           "<p>Every scene is drawn twice: by the CPU, and by GL, which rasterises the same triangles with its own vertex "
           "stage, filters the map and decides for the same receivers. Tables count what differs, and say by how much at "
           "most.</p>\n"
           "<ul><li><b>edge texels</b>: covered by a triangle on one side and not on the other. GL gives a rasteriser its "
           "corners in single precision, gnomon has them in double.\n"
           "<li><b>depths</b>, <b>bounds</b>: of texels that both cover. A GPU interpolates in single precision, so a code"
           " may be the next one; at a silhouette another triangle may be the nearest.\n"
           "<li><b>soft texels</b>, <b>receivers</b>: what becomes of both.\n"
           "<li><b>soft texels from equal casters</b>: GL filters what the CPU cast. It has to be 0: all that follows the "
           "rasteriser is the same by construction.\n"
           "<li><b>receivers on equal soft maps</b>: GL decides on what the CPU filtered. An intensity is a quotient in "
           "single precision there, and halves and floats are blended in it, so last places may differ; <b>decided "
           "otherwise</b> are those that are lit on one side alone.</ul>\n"
           "<p>In difference pictures grey is the same, red is darker by GL and blue lighter, as many times too strong as "
           "the caption says.</p>\n"
           "<p><a href=\"table.csv\">table.csv</a> &middot; <a href=\"contact_sheet.png\">contact_sheet.png</a></p>\n";
}

} // namespace gl_headless
