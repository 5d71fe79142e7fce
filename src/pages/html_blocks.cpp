// Writes blocks.

#include "pages/html_blocks.hpp"

#include "pages/html_text.hpp"
#include "pages/plot_json.hpp"

#include <algorithm>
#include <stdexcept>

namespace carom::detail {

namespace {

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
         "<noscript><p class=\"note\">This plot is drawn by a script, which is switched off here. Its numbers stand in the "
         "source of the page, as JSON, in the element numbers-" +
         id + ".</p></noscript>\n" + caption(plot.caption) +
         "<details class=\"numbers\"><summary>Numbers</summary><div></div></details>\n"
         "<script type=\"application/json\" id=\"numbers-" +
         id + "\">" + plot_json(plot) + "</script>\n</figure>\n";
}

std::string html(const EmbeddedPage& page) {
  return "<figure class=\"embedded\">\n<noscript><p class=\"note\">What stands here is made by a script, which is switched "
         "off.</p></noscript>\n<iframe title=\"" +
         html_text(page.title) + "\" srcdoc=\"" + html_document_text(page.html) + "\"></iframe>\n</figure>\n";
}

}  // namespace

std::string html_block(const Block& block) {
  return std::visit([](const auto& content) { return html(content); }, block);
}

}  // namespace carom::detail
