// Puts a page together: head, contents, sections and their blocks, facts, and the embedded files that draw it.

#include "pages/html_parts.hpp"

#include <carom/pages/page.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace carom {

namespace {

using detail::embedded_text;
using detail::html_prose;
using detail::html_text;

std::string caption(const std::string& text) {
  return text.empty() ? std::string() : "<p class=\"caption\">" + html_prose(text) + "</p>\n";
}

/// Every cell of the column begins like a number or is a dash or empty, and one begins like a number: it is set flush right.
bool is_numeric(const TextTable& table, std::size_t column) {
  bool any = false;
  for (const auto& row : table.rows) {
    const std::string& cell = row[column];
    const std::size_t digit = cell.find_first_not_of("+-.<>~ ");
    const bool is_number = digit < cell.size() && cell[digit] >= '0' && cell[digit] <= '9';
    const bool is_blank = cell.empty() || cell == "-" || cell == "\u2013" || cell == "\u2014";
    if (!is_number && !is_blank) return false;
    any = any || is_number;
  }
  return any;
}

std::string html(const Paragraph& paragraph) { return "<p>" + html_prose(paragraph.text) + "</p>\n"; }

std::string html(const Listing& listing) {
  return "<details class=\"listing\"><summary>" + html_text(listing.title) + "</summary><pre>" + html_text(listing.text) +
         "</pre></details>\n";
}

std::string html(const TextTable& table) {
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size())
      throw std::invalid_argument("table " + table.title + ": a row is not as long as the columns");
  }
  std::vector<const char*> attributes;
  for (std::size_t i = 0; i < table.columns.size(); ++i) attributes.push_back(is_numeric(table, i) ? " class=\"number\"" : "");

  std::string text = "<figure class=\"table\">\n<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" +
                     html_text(table.title.empty() ? "Table" : table.title) + "\"><table>\n";
  if (!table.title.empty()) text += "<caption>" + html_text(table.title) + "</caption>\n";
  const bool has_heads = std::any_of(table.columns.begin(), table.columns.end(), [](const std::string& c) { return !c.empty(); });
  if (has_heads) text += "<thead><tr>";
  for (std::size_t i = 0; has_heads && i < table.columns.size(); ++i) {
    text += "<th scope=\"col\"" + std::string(attributes[i]) + ">" + html_text(table.columns[i]) + "</th>";
  }
  if (has_heads) text += "</tr></thead>\n";
  text += "<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const char* const open = i == 0 ? "<th scope=\"row\"" : "<td";
      const char* const close = i == 0 ? "</th>" : "</td>";
      text += open + std::string(attributes[i]) + ">" + html_text(row[i]) + close;
    }
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table></div>\n" + caption(table.caption) + "</figure>\n";
}

std::string html(const Plot& plot) {
  const std::string id = html_text(plot.id);
  return "<figure class=\"plot\" id=\"plot-" + id + "\">\n<h3>" + html_text(plot.title) +
         "</h3>\n<div class=\"canvas\" role=\"img\" aria-label=\"" + html_text("Plot: " + plot.title) + "\"></div>\n" +
         "<noscript><p class=\"note\">This plot is drawn by a script, which is switched off here. Its numbers are in the "
         "source of the page, as JSON, in the element numbers-" +
         id + ".</p></noscript>\n" + caption(plot.caption) +
         "<details class=\"numbers\"><summary>Numbers</summary><div></div></details>\n"
         "<script type=\"application/json\" id=\"numbers-" +
         id + "\">" + detail::plot_json(plot) + "</script>\n</figure>\n";
}

std::string html(const EmbeddedPage& page) {
  return "<figure class=\"embedded\">\n<noscript><p class=\"note\">This part is drawn by a script, which is switched "
         "off.</p></noscript>\n<iframe title=\"" +
         html_text(page.title) + "\" srcdoc=\"" + detail::html_document_text(page.html) + "\"></iframe>\n</figure>\n";
}

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
    for (const Block& block : page.sections[i].blocks)
      text += std::visit([](const auto& content) { return html(content); }, block);
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

void add_build(Facts& facts, const BuildInfo& build) {
  facts.emplace_back("Program", fmt::format("carom {} (commit {})", build.version, build.commit));
  facts.emplace_back("Compiler", fmt::format("{}; {}", build.compiler, build.flags));
}

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
