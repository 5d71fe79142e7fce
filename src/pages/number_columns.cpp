// Bytes as text for a page: four characters for three bytes.

#include "pages/number_columns.hpp"

namespace carom::detail {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t at) { return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U; };
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::uint32_t group = (byte(at) << 16U) | (byte(at + 1) << 8U) | byte(at + 2);
    for (std::size_t k = 0; k < 4; ++k) text += at + k > bytes.size() ? '=' : digits[(group >> (18 - 6 * k)) & 63U];
  }
  return text;
}

}  // namespace carom::detail
