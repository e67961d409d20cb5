#include "report.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <filesystem>

namespace gallery {

namespace {

constexpr int gap = 6, title_height = 30, caption_height = 22;

/// printf into a string; `format` is always a literal of this file.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
    char buffer[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    return buffer;
}

std::string escaped(const std::string& plain) {
    std::string safe;
    for (const char c : plain) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

std::string table_of(const row& r) {
    std::string lines = "<table><tr><th>format<th>bytes per texel<th>RMSE<th>worst error<th>false shadow<th>false light<th>tiles "
                        "touched<th>ns per texel<th>ns per receiver</tr>\n";
    const int all_tiles = map_extent.width / tile_size * (map_extent.height / tile_size);
    for (const measured& m : r.table)
        lines += text("<tr><td>%s<td>%d<td>%.5f<td>%.3f<td>%.3f %%<td>%.3f %%<td>%d of %d<td>%.1f<td>%.1f</tr>\n",
                      m.what.format.c_str(), m.what.bytes_per_texel, m.error.rmse, m.error.max_error, 100 * m.error.false_shadow,
                      100 * m.error.false_light, m.what.tiles, all_tiles, m.what.ns_per_texel, m.what.ns_per_receiver);
    return lines + "</table>\n";
}

constexpr const char* head = R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>gnomon gallery</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fafafa; max-width: 1280px; margin: 2em auto; padding: 0 1em }
h1, h2 { font-weight: 600; line-height: 1.2 } h2 { margin-top: 2.5em; font-size: 1.25em }
.row { display: grid; grid-template-columns: repeat(auto-fill, minmax(290px, 1fr)); gap: 10px }
figure { margin: 0 } img { width: 100%; display: block; border-radius: 3px } figcaption { font-size: .85em; color: #555 }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums } td, th { padding: .2em .8em; text-align: right; border-bottom: 1px solid #ddd }
td:first-child, th:first-child { text-align: left } th { font-weight: 600; font-size: .85em } code { font-size: .95em }
</style>
<h1>gnomon: soft shadows, measured</h1>
)";

} // namespace

picture contact_sheet(const std::vector<row>& rows) {
    std::size_t columns = 0;
    for (const row& r : rows)
        columns =
            (std::max)(columns, static_cast<std::size_t>(std::count_if(r.exhibits.begin(), r.exhibits.end(),
                                                                       [](const exhibit& e) { return !e.short_caption.empty(); })));
    picture sheet(gap + static_cast<int>(columns) * (thumbnail_width + gap),
                  static_cast<int>(rows.size()) * (title_height + caption_height + thumbnail_height) + title_height + gap);
    int y = 0;
    for (const row& r : rows) {
        sheet.write(r.about.title, gap, y + 10, 2, 0);
        int x = gap;
        for (const exhibit& e : r.exhibits) {
            if (e.short_caption.empty()) continue;
            sheet.write(e.short_caption, x, y + title_height + 1, 2, 110);
            sheet.place(e.thumbnail, x, y + title_height + caption_height);
            x += thumbnail_width + gap;
        }
        y += title_height + caption_height + thumbnail_height;
    }
    sheet.write("red: too dark   blue: too light   errors are those of 8 bit, so many times too strong", gap, y + 10, 2, 110);
    return sheet;
}

std::string csv(const std::vector<row>& rows) {
    std::string lines =
        "scene,format,kernel,bytes_per_texel,rmse,max_error,false_shadow,false_light,tiles,ns_per_texel,ns_per_receiver\n";
    for (const row& r : rows)
        for (const measured& m : r.table)
            lines += text("%s,%s,%s,%d,%.6g,%.6g,%.6g,%.6g,%d,%.1f,%.1f\n", r.about.id.c_str(), m.what.format.c_str(), kernel_name,
                          m.what.bytes_per_texel, m.error.rmse, m.error.max_error, m.error.false_shadow, m.error.false_light,
                          m.what.tiles, m.what.ns_per_texel, m.what.ns_per_receiver);
    return lines;
}

std::string html(const std::vector<row>& rows, const std::string& mesh_name) {
    std::string page = head;
    page +=
        "<p>Mesh: " + escaped(std::filesystem::path(mesh_name).filename().string()) +
        text(". Shadow map %d x %d, tiles of %d, kernel <code>%s</code>. ", map_extent.width, map_extent.height, tile_size,
             escaped(kernel_name).c_str()) +
        "Truth is exact percentage-closer filtering of the unfiltered map with the same kernel in double precision, blended from "
        "the same four texels; the hard test reads the nearest texel. Errors are of shadow intensity, 0 to 1, over the camera "
        "samples that receive: those on the map whose surface is turned to the light. False shadow: truth at most 0.5/255 and more "
        "than 2/255 answered. False light: truth at least 0.5 and more than 0.25 of it missing. Rows a to d decide with bias "
        "towards shadow, as is right for casters that never receive. In difference pictures red is too dark and blue too light, as "
        "many times too strong as the caption says. "
        "Times are medians of five on a shared machine, scalar code on one core: good for comparing rows of one run, no more.</p>\n"
        "<p><a href=\"table.csv\">table.csv</a> &middot; <a href=\"contact_sheet.png\">contact_sheet.png</a></p>\n";
    for (const row& r : rows) {
        page += "<h2 id=\"" + r.about.id + "\">" + escaped(r.about.title) + "</h2>\n<p>" + escaped(r.about.look_for) +
                "</p>\n<div class=\"row\">\n";
        for (const exhibit& e : r.exhibits)
            page += "<figure><a href=\"" + e.file + "\"><img src=\"" + e.file + "\" loading=\"lazy\" alt=\"" + escaped(e.caption) +
                    "\"></a><figcaption>" + escaped(e.caption) + "</figcaption></figure>\n";
        page += "</div>\n" + table_of(r) + text("<p>%zu receivers.</p>\n", r.receivers);
    }
    return page + "</html>\n";
}

} // namespace gallery
