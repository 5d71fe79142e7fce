// Puts a page together: head, contents, sections, facts, and the embedded files that draw it.

#include "pages/embedded_files.hpp"
#include "pages/html_blocks.hpp"
#include "pages/html_text.hpp"
#include "pages/page.hpp"

#include <set>
#include <stdexcept>

namespace carom {

namespace {

using detail::embedded_text;
using detail::html_prose;
using detail::html_text;

constexpr std::size_t sections_without_contents = 3;  // more do not fit on a screen

void check_ids(const Page& page) {
  std::set<std::string> ids;
  for (const Section& section : page.sections) {
    for (const Block& block : section.blocks) {
      const Plot* const plot = std::get_if<Plot>(&block);
      if (plot == nullptr) continue;
      const bool is_fit =
          !plot->id.empty() && plot->id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
      if (!is_fit) throw std::invalid_argument("\"" + plot->id + "\" cannot be the id of a plot");
      if (!ids.insert(plot->id).second) throw std::invalid_argument("two plots have the id " + plot->id);
    }
  }
}

std::string anchor(std::size_t section) { return "section-" + std::to_string(section + 1); }

std::string script(const std::string& name) { return "<script>\n" + embedded_text(name) + "</script>\n"; }

std::string head(const Page& page) {
  const std::string generator =
      page.generator.empty() ? "" : "<meta name=\"generator\" content=\"" + html_text(page.generator) + "\">\n";
  return "<head>\n<meta charset=\"utf-8\">\n" + generator +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         std::string(detail::page_policy) + "\">\n<title>" + html_text(page.title) + "</title>\n<style>\n" +
         embedded_text("page/page.css") + "</style>\n" + script("page/errors.js") + "</head>\n";
}

std::string header(const Page& page) {
  std::string text = "<header>\n<h1>" + html_text(page.title) + "</h1>\n";
  if (!page.subtitle.empty()) text += "<p class=\"subtitle\">" + html_text(page.subtitle) + "</p>\n";
  if (!page.lead.empty()) text += "<p class=\"lead\">" + html_prose(page.lead) + "</p>\n";
  if (!page.key_numbers.empty()) {
    text += "<dl class=\"key-numbers\">\n";
    for (const KeyNumber& number : page.key_numbers) {
      text += "<div><dt>" + html_text(number.label) + "</dt><dd>" + html_text(number.value) + "</dd></div>\n";
    }
    text += "</dl>\n";
  }
  return text + "</header>\n";
}

std::string contents(const Page& page) {
  if (page.sections.size() <= sections_without_contents) return {};
  std::string text = "<nav aria-label=\"Contents\"><ol>\n";
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    text += "<li><a href=\"#" + anchor(i) + "\">" + html_text(page.sections[i].heading) + "</a></li>\n";
  }
  return text + "</ol></nav>\n";
}

std::string sections(const Page& page) {
  std::string text = "<main>\n";
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    text += "<section id=\"" + anchor(i) + "\">\n<h2>" + html_text(page.sections[i].heading) + "</h2>\n";
    for (const Block& block : page.sections[i].blocks) text += detail::html_block(block);
    text += "</section>\n";
  }
  return text + "</main>\n";
}

std::string footer(const Page& page) {
  std::string text = "<footer>\n";
  if (!page.facts.empty()) {
    text += "<h2>Where this comes from</h2>\n<dl class=\"facts\">\n";
    for (const auto& [name, value] : page.facts) text += "<dt>" + html_text(name) + "</dt><dd>" + html_text(value) + "</dd>\n";
    text += "</dl>\n";
  }
  return text +
         "<details class=\"licence\"><summary>Plots are drawn by plotly.js, which this file contains under the MIT "
         "licence</summary><pre>" +
         html_text(embedded_text("plotly/LICENSE")) + "</pre></details>\n</footer>\n";
}

}  // namespace

std::string html_page(const Page& page) {
  check_ids(page);
  std::string text = "<!doctype html>\n<html lang=\"en\">\n" + head(page) + "<body>\n" + header(page) + contents(page) +
                     sections(page) + footer(page);
  for (const char* const name : {"plotly/plotly-basic.min.js", "page/theme.js", "page/numbers.js", "page/traces.js",
                                 "page/layout.js", "page/export.js", "page/embedded.js", "page/page.js"}) {
    text += script(name);
  }
  return text + "</body>\n</html>\n";
}

}  // namespace carom
