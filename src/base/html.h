// Text and pictures for pages that are written by hand.
#pragma once

#include <span>
#include <string>

namespace roomlight {

// Text fit for HTML and SVG, between tags and in attributes with double or single quotes; control characters become
// spaces.
std::string htmlEscaped(const std::string& text);

// A whole page that needs nothing else: `body` in one column, in the style that all reports share; `style` comes after
// that. `title` is text.
std::string htmlPage(const std::string& title, const std::string& style, const std::string& body);

// RFC 4648, with padding: what a data: URI takes.
std::string base64(std::span<const char> bytes);

}  // namespace roomlight
