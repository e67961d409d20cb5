#include "report.hpp"

#include "page.hpp"

#include <filesystem>

namespace gallery {

std::string numbers_of(const std::vector<measured>& table, std::size_t receivers) {
    std::string lines = "<table><tr><th>format<th>bytes per texel<th>RMSE<th>worst error<th>false shadow<th>false light<th>tiles "
                        "touched<th>ns per texel<th>ns per receiver</tr>\n";
    const int all_tiles = map_extent.width / tile_size * (map_extent.height / tile_size);
    for (const measured& m : table)
        lines +=
            formatted("<tr><td>%s<td>%d<td>%.5f<td>%.3f<td>%.3f %%<td>%.3f %%<td>%d of %d<td>%.1f<td>%.1f</tr>\n",
                      m.what.format.c_str(), m.what.bytes_per_texel, m.error.rmse, m.error.max_error, 100 * m.error.false_shadow,
                      100 * m.error.false_light, m.what.tiles, all_tiles, m.what.ns_per_texel, m.what.ns_per_receiver);
    return lines + "</table>\n" + formatted("<p>%zu receivers.</p>\n", receivers);
}

std::string csv_head() {
    return "scene,format,kernel,bytes_per_texel,rmse,max_error,false_shadow,false_light,tiles,ns_per_texel,ns_per_receiver\n";
}

std::string csv_of(const std::string& id, const std::vector<measured>& table) {
    std::string lines;
    for (const measured& m : table)
        lines += formatted("%s,%s,%s,%d,%.6g,%.6g,%.6g,%.6g,%d,%.1f,%.1f\n", id.c_str(), m.what.format.c_str(), kernel_name,
                           m.what.bytes_per_texel, m.error.rmse, m.error.max_error, m.error.false_shadow, m.error.false_light,
                           m.what.tiles, m.what.ns_per_texel, m.what.ns_per_receiver);
    return lines;
}

std::string about_the_gallery(const std::string& mesh_name) {
    return "<p>Mesh: " + escaped(std::filesystem::path(mesh_name).filename().string()) +
           formatted(". Shadow map %d x %d, tiles of %d, kernel <code>%s</code>. ", map_extent.width, map_extent.height, tile_size,
                     escaped(kernel_name).c_str()) +
           "Truth is exact percentage-closer filtering of the unfiltered map with the same kernel in double precision, "
           "blended from the same four texels; the hard test reads the nearest texel. Errors are of shadow intensity, 0 to "
           "1, over the camera samples that receive: those on the map whose surface is turned to the light. False shadow: "
           "truth at most 0.5/255 and more than 2/255 answered. False light: truth at least 0.5 and more than 0.25 of it "
           "missing. Rows a to d decide with bias towards shadow, as is right for casters that never receive. In difference "
           "pictures red is too dark and blue too light, as many times too strong as the caption says. Times are medians of "
           "five on a shared machine, scalar code on one core: good for comparing rows of one run, no more.</p>\n"
           "<p><a href=\"table.csv\">table.csv</a> &middot; <a href=\"contact_sheet.png\">contact_sheet.png</a></p>\n";
}

} // namespace gallery
