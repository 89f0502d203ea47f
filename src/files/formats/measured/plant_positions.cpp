#include "files/formats/measured/plant_positions.h"

#include "base/text.h"
#include "base/text_reader.h"
#include "files/formats/measured/number_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

namespace sunfleck {

namespace {

constexpr double farthest_m = 1e7;
constexpr double largest_scale = 1e6;
constexpr double whole_turn_deg = 360.0;

constexpr std::string_view known_columns[] = {"plant", "x", "y", "z", "heading", "scale"};

void check_position_columns(const NumberTable& table, HeightColumn height) {
  for (const std::string& column : table.columns) {
    const auto is_known = [](std::string_view name) {
      return std::find(std::begin(known_columns), std::end(known_columns), name) != std::end(known_columns);
    };
    if (is_known(column)) continue;
    if (parse_number(column))
      refuse_line(table.file, table.header_line, fmt::format("column {}", in_quotes(column)),
                  "the first line must name the columns", "begin with a line such as plant,x,z,heading,scale");
    if (is_known(lower_case(column)))
      refuse_line(table.file, table.header_line, fmt::format("column {}", in_quotes(column)),
                  "names of columns are in small letters", fmt::format("write {}", lower_case(column)));
    refuse_line(table.file, table.header_line, fmt::format("column {}", in_quotes(column)), "it is not known here",
                fmt::format("use {}", fmt::join(known_columns, ", ")));
  }
  const char* other = height == HeightColumn::y ? "z" : "y";
  for (const char* column : {"x", other}) {
    if (table.find_column(column)) continue;
    refuse_line(table.file, table.header_line, fmt::format("no column {}", column),
                height == HeightColumn::y ? "plants need x (south) and z (west)" : "plants need x (east) and y (north)",
                fmt::format("begin with a line such as plant,x,{},heading,scale", other));
  }
}

// Reads the cells of one row.
class RowReader {
 public:
  RowReader(const NumberTable& table, const NumberTable::Row& row, HeightColumn height)
      : table_(table), row_(row), height_(height == HeightColumn::y ? "y" : "z") {}

  [[nodiscard]] PlantPosition read() const {
    PlantPosition position;
    position.x_m = metres("x");
    position.y_m = metres("y");
    position.z_m = metres("z");
    if (table_.find_column("heading")) {
      position.heading_deg = in_range("heading", -whole_turn_deg, whole_turn_deg, "give degrees clockwise seen from above");
    }
    if (table_.find_column("scale")) {
      position.scale = in_range("scale", 0.0, largest_scale, "give 1 for the size of the mesh");
      if (position.scale == 0.0) refuse_cell("scale", 0.0, "must be above 0", "give 1 for the size of the mesh");
    }
    if (table_.find_column("plant")) position.plant = plant();
    return position;
  }

 private:
  // Returns 0 for a height without a column.
  [[nodiscard]] double metres(std::string_view column) const {
    if (column == height_ && !table_.find_column(column)) return 0.0;
    return in_range(column, -farthest_m, farthest_m, "give metres");
  }

  [[nodiscard]] double in_range(std::string_view column, double lo, double hi, const char* cure) const {
    const double value = row_.cells[table_.column(column)];
    if (std::isnan(value)) {
      refuse_line(table_.file, row_.line, fmt::format("{} is empty", column), "every row needs all columns", "fill it in");
    }
    if (value < lo || value > hi) refuse_cell(column, value, fmt::format("must lie in {:g}..{:g}", lo, hi), cure);
    return value;
  }

  [[nodiscard]] std::uint32_t plant() const {
    constexpr double largest = 1e9;
    const double number = in_range("plant", 1.0, largest, "number the plants from 1");
    if (number != std::floor(number)) refuse_cell("plant", number, "must be a whole number", "number the plants from 1");
    return static_cast<std::uint32_t>(number);
  }

  [[noreturn]] void refuse_cell(std::string_view column, double value, const std::string& why, const char* cure) const {
    refuse_line(table_.file, row_.line, fmt::format("{} = {:g}", column, value), why, cure);
  }

  const NumberTable& table_;
  const NumberTable::Row& row_;
  const std::string_view height_;
};

}  // namespace

std::vector<PlantPosition> read_plant_positions(const std::filesystem::path& file, HeightColumn height, SourceFiles* files) {
  const NumberTable table = read_number_table(
      file, [height](const NumberTable& columns) { check_position_columns(columns, height); }, files);
  std::vector<PlantPosition> positions;
  std::map<std::uint32_t, std::size_t> line_of;
  for (const NumberTable::Row& row : table.rows) {
    positions.push_back(RowReader(table, row, height).read());
    if (!positions.back().plant) continue;
    const auto [earlier, fresh] = line_of.try_emplace(*positions.back().plant, row.line);
    if (fresh) continue;
    refuse_line(table.file, row.line, fmt::format("plant = {}", *positions.back().plant),
                fmt::format("line {} has the same number", earlier->second), "number every plant differently");
  }
  return positions;
}

}  // namespace sunfleck
