#include "files/formats/measured/measured_reader.h"

#include "base/file.h"
#include "base/text_reader.h"
#include "files/formats/measured/number_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace sunfleck {
namespace {

constexpr const char* columns_wanted = "give the header height_m,sunfleck_ratio";
constexpr double largest_percent = 100.0;

MeasuredRatio checked(const NumberTable& table, const NumberTable::Row& row, std::size_t height, std::size_t ratio) {
  const MeasuredRatio point{row.cells[height], row.cells[ratio]};
  if (std::isnan(point.height_m))
    refuse_line(table.file, row.line, "height_m is empty", "every row needs both values", "fill it in");
  if (std::isnan(point.sunfleck_ratio))
    refuse_line(table.file, row.line, "sunfleck_ratio is empty", "every row needs both values", "fill it in or remove the row");
  if (point.height_m < 0.0) {
    refuse_line(table.file, row.line, fmt::format("height_m = {:g}", point.height_m), "must not lie below the ground",
                "give the height above the ground in metres");
  }
  if (point.sunfleck_ratio < 0.0 || point.sunfleck_ratio > 1.0) {
    const bool percent = point.sunfleck_ratio > 1.0 && point.sunfleck_ratio <= largest_percent;
    refuse_line(table.file, row.line, fmt::format("sunfleck_ratio = {:g}", point.sunfleck_ratio), "must lie in 0..1",
                percent ? fmt::format("give {:g} if percent was meant", point.sunfleck_ratio / largest_percent)
                        : "give the share of the horizontal plane in direct sun");
  }
  return point;
}

void check_columns(const NumberTable& table) {
  if (table.find_column("height_m") && table.find_column("sunfleck_ratio") && table.columns.size() == 2) return;
  const std::string found = fmt::format("{}", fmt::join(table.columns, ","));
  refuse_line(table.file, table.header_line, fmt::format("columns {}", in_quotes(found)),
              "exactly height_m and sunfleck_ratio are expected", columns_wanted);
}

}  // namespace

MeasuredProfile read_measured(const std::filesystem::path& file) {
  const NumberTable table = read_number_table(file, check_columns);
  const std::size_t height = table.column("height_m");
  const std::size_t ratio = table.column("sunfleck_ratio");
  MeasuredProfile profile;
  profile.name = printable(file.filename().string());
  for (const NumberTable::Row& row : table.rows) profile.points.push_back(checked(table, row, height, ratio));
  return profile;
}

}  // namespace sunfleck
