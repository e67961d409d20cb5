#include "page.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace gallery {

namespace {

constexpr int gap = 6, title_height = 30, caption_height = 22;

constexpr const char* head = R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fafafa; max-width: 1280px; margin: 2em auto; padding: 0 1em }
h1, h2 { font-weight: 600; line-height: 1.2 } h2 { margin-top: 2.5em; font-size: 1.25em }
.row { display: grid; grid-template-columns: repeat(auto-fill, minmax(290px, 1fr)); gap: 10px }
figure { margin: 0 } img { width: 100%; display: block; border-radius: 3px } figcaption { font-size: .85em; color: #555 }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums } td, th { padding: .2em .8em; text-align: right; border-bottom: 1px solid #ddd }
td:first-child, th:first-child { text-align: left } th { font-weight: 600; font-size: .85em } code { font-size: .95em }
</style>
)";

} // namespace

std::string formatted(const char* format, ...) {
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

picture contact_sheet(const std::vector<row>& rows, const std::string& legend) {
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
    sheet.write(legend, gap, y + 10, 2, 110);
    return sheet;
}

std::string html(const std::string& title, const std::string& about, const std::vector<row>& rows) {
    std::string page = head + ("<title>" + title + "</title>\n<h1>" + title + "</h1>\n") + about;
    for (const row& r : rows) {
        page += "<h2 id=\"" + r.about.id + "\">" + escaped(r.about.title) + "</h2>\n<p>" + escaped(r.about.look_for) +
                "</p>\n<div class=\"row\">\n";
        for (const exhibit& e : r.exhibits)
            page += "<figure><a href=\"" + e.file + "\"><img src=\"" + e.file + "\" loading=\"lazy\" alt=\"" + escaped(e.caption) +
                    "\"></a><figcaption>" + escaped(e.caption) + "</figcaption></figure>\n";
        page += "</div>\n" + r.numbers;
    }
    return page + "</html>\n";
}

} // namespace gallery
