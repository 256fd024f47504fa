// Pages that are written by hand and need nothing else.
#pragma once

#include <span>
#include <string>

namespace roomlight::report {

// Text fit for HTML and SVG, between tags and in attributes with double or single quotes; control characters become
// spaces.
std::string escaped(const std::string& text);

// ` name="text"`, or nothing without a text.
std::string attribute(const char* name, const std::string& text);

// A whole page: `body` in one column, in the style that reports share; `style` comes after that. `title` is text.
// `plots`: what draws those of the body (viewer/dist-reports), put in where it has any; empty: their words stay.
std::string page(const std::string& title, const std::string& style, const std::string& body,
                 const std::string& plots = {});
// The same without the shared style and the column.
std::string plainPage(const std::string& title, const std::string& style, const std::string& body,
                      const std::string& plots = {});

// An element that becomes a plot where scripts run; else it says that tables of the page have its numbers, as they
// must. `kind`: one of viewer/reports/src/main.ts, whose data is `json`. `label`: its accessible name, text.
std::string plot(const std::string& kind, const std::string& label, const std::string& json);

// An element of the page whose bytes are in the page itself. `alt` is text.
std::string jpegPicture(const std::string& alt, std::span<const char> jpeg);
// Pictures or drawings with what is said below them; both are HTML, `caption` may be empty. `kind`: its class.
std::string figure(const std::string& content, const std::string& caption = {}, const std::string& kind = {});

}  // namespace roomlight::report
