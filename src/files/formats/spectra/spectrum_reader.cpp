#include "files/formats/spectra/spectrum_reader.h"

#include "base/file.h"
#include "base/text.h"
#include "base/text_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sunfleck {
namespace {

constexpr std::uintmax_t most_bytes = 50'000'000;
constexpr double shortest_nm = 100.0, longest_nm = 1e6;
constexpr double rounding = 1e-9;  // of shares that were written as decimal fractions

using Path = std::filesystem::path;
using Cells = std::vector<std::string_view>;

constexpr std::string_view table_cure = "give columns such as wavelength_nm,reflectance,transmittance";

Cells cells_of(std::string_view line, char separator) {
  Cells cells;
  if (separator == ' ') {
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) cells.push_back(unquoted(word));
    return cells;
  }
  split_cells(line, cells, separator);
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();  // a separator at the end of the line
  return cells;
}

// Returns what separates the columns of a line. A comma is the decimal mark if words between blanks are numbers with it.
char separator_of_row(std::string_view line) {
  const char separator = separator_of(line);
  if (separator != ',') return separator;
  if (line.find(',') == line.npos) return ' ';
  const Cells words = cells_of(line, ' ');
  const auto is_number = [](std::string_view word) { return parse_number(word, ' ').has_value(); };
  return words.size() > 1 && std::all_of(words.begin(), words.end(), is_number) ? ' ' : ',';
}

// Returns whether the line is a row of numbers, judged by its first cell.
bool begins_with_number(std::string_view line) {
  const char separator = separator_of_row(line);
  const Cells cells = cells_of(line, separator);
  return cells.size() > 1 && parse_number(cells.front(), separator).has_value();
}

struct Row {
  std::size_t line = 0;
  std::vector<double> cells;
};

struct SpectralTable {
  Path file;
  std::string preamble;  // in lower case
  std::size_t header_line = 0;
  std::vector<std::string> columns;  // in lower case; empty if they have no names
  std::vector<Row> rows;             // ascending wavelengths, nm
  std::size_t wavelength = 0;        // its column
};

bool says(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) { return text.find(word) != text.npos; });
}

void take_header(SpectralTable& table, std::string_view line, std::size_t number, std::size_t columns, char separator) {
  const Cells cells = cells_of(line, separator);
  if (cells.size() != columns) return;
  table.header_line = number;
  for (const std::string_view cell : cells) table.columns.push_back(lower_case(cell));
}

void take_row(SpectralTable& table, std::string_view line, std::size_t number, std::size_t columns, char separator) {
  const Cells cells = cells_of(line, separator);
  if (cells.size() != columns) {
    refuse_line(table.file, number, fmt::format("{} cells", cells.size()), fmt::format("the rows before have {}", columns),
                "give every row the same columns");
  }
  Row row{number, {}};
  for (const std::string_view cell : cells) {
    const auto value = parse_number(cell, separator);
    if (!value) refuse_line(table.file, number, in_quotes(cell), "not a finite number", "correct the number");
    row.cells.push_back(*value);
  }
  table.rows.push_back(std::move(row));
}

// Reads the table as it stands, without its meaning.
SpectralTable read_rows(const Path& file, SourceFiles* files) {
  const std::string bytes = read_source(file, files, most_bytes);
  SpectralTable table{.file = file};
  std::string_view before;
  std::size_t before_number = 0, columns = 0;
  char separator = ' ';
  for (LineReader lines(without_mark(bytes)); lines.next();) {
    const std::string_view line = trimmed(lines.line());
    if (line.empty()) continue;
    if (columns == 0 && begins_with_number(line)) {
      separator = separator_of_row(line);
      columns = cells_of(line, separator).size();
      take_header(table, before, before_number, columns, separator);
    }
    if (columns > 0 && line.front() != '#') {
      take_row(table, line, lines.number(), columns, separator);
    } else if (columns == 0) {
      table.preamble += lower_case(line) + '\n';
      before = line.front() == '#' ? trimmed(line.substr(1)) : line;
      before_number = lines.number();
    }
  }
  if (table.rows.size() < 2) {
    refuse_line(file, 0, fmt::format("{} rows of numbers", table.rows.size()), "a spectrum needs at least two, in columns",
                table_cure);
  }
  return table;
}

// Returns the column whose name begins with the first of the words that any does, or is one of the letters.
std::optional<std::size_t> find_column(const SpectralTable& table, std::initializer_list<std::string_view> words,
                                       std::initializer_list<std::string_view> letters) {
  for (const std::string_view word : words) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (table.columns[c].starts_with(word)) return c;
    }
  }
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string_view name = table.columns[c];
    const std::string_view alone = trimmed(name.substr(0, name.find_first_of("([_ %/")));
    if (std::find(letters.begin(), letters.end(), alone) != letters.end()) return c;
  }
  return std::nullopt;
}

[[noreturn]] void refuse_columns(const SpectralTable& table, std::string_view wanted) {
  refuse_line(table.file, table.header_line, fmt::format("columns {}", fmt::join(table.columns, ", ")),
              fmt::format("none of them is named {}", wanted), table_cure);
}

// Finds the column of wavelengths, converts them to nm and sorts the rows by them.
void order_by_wavelength(SpectralTable& table) {
  if (!table.columns.empty()) {
    const auto found = find_column(table, {"wavelength", "lambda", "wvl"}, {"wl", "w", "nm", "um"});
    if (!found) refuse_columns(table, "wavelength");
    table.wavelength = *found;
  }
  std::vector<Row>& rows = table.rows;
  const auto nm = [&](const Row& row) -> double { return row.cells[table.wavelength]; };
  if (nm(rows.front()) > nm(rows.back())) std::reverse(rows.begin(), rows.end());
  constexpr double longest_um = 100.0;
  const std::string_view name = table.columns.empty() ? std::string_view() : table.columns[table.wavelength];
  const bool um = says(name, {"um", "µm", "μm", "micro"}) || nm(rows.back()) < longest_um;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double& at_nm = rows[k].cells[table.wavelength];
    if (um) at_nm *= 1000.0;
    if (at_nm < shortest_nm || at_nm > longest_nm) {
      refuse_line(table.file, rows[k].line, fmt::format("wavelength {:g} nm", at_nm), "it must be 100 to 1000000 nm",
                  "give nm, or micrometres in a column named wavelength_um");
    }
    if (k > 0 && at_nm <= nm(rows[k - 1])) {
      refuse_line(table.file, rows[k].line, fmt::format("wavelength {:g} nm", at_nm),
                  "the rows must ascend or descend by wavelength, and none may repeat", "sort them, and keep one of each");
    }
  }
}

Spectrum spectrum_in(const SpectralTable& table, std::size_t column) {
  Spectrum spectrum;
  for (const Row& row : table.rows) {
    spectrum.wavelength_nm.push_back(row.cells[table.wavelength]);
    spectrum.values.push_back(row.cells[column]);
  }
  return spectrum;
}

Spectrum shares_in(const SpectralTable& table, std::size_t column, std::string_view what) {
  Spectrum spectrum = spectrum_in(table, column);
  const std::string_view name = table.columns.empty() ? what : std::string_view(table.columns[column]);
  // Remarks above the table may be about something else that is in percent.
  const bool no_shares =
      std::any_of(spectrum.values.begin(), spectrum.values.end(), [](double v) { return v > 1.0 + rounding; });
  const bool percent = says(name, {"%", "percent", "pct"}) || (no_shares && says(table.preamble, {"percent", "(%)"}));
  for (std::size_t k = 0; k < spectrum.values.size(); ++k) {
    double& share = spectrum.values[k];
    if (percent) share *= 0.01;
    if (share >= 0.0 && share <= 1.0 + rounding) continue;
    refuse_line(table.file, table.rows[k].line, fmt::format("{} {:g}", what, share), "it must be a share from 0 to 1",
                share > 1.0 && !percent ? fmt::format("name the column {} (%) if these are percent", what)
                                        : "correct the number; instruments give such values where they see noise");
  }
  return spectrum;
}

}  // namespace

SurfaceSpectra read_surface_spectra(const Path& file, SourceFiles* files) {
  SpectralTable table = read_rows(file, files);
  const bool named = !table.columns.empty();
  const std::size_t columns = table.rows.front().cells.size();
  if (!named && columns > 3) {
    refuse_line(file, table.rows.front().line, fmt::format("{} columns without names", columns),
                "at most wavelength, reflectance and transmittance can be told apart without them", table_cure);
  }
  order_by_wavelength(table);
  const auto reflectance = named ? find_column(table, {"refl", "rho"}, {"r"}) : std::optional<std::size_t>(1);
  const auto transmittance = named         ? find_column(table, {"trans", "tau"}, {"t"})
                             : columns > 2 ? std::optional<std::size_t>(2)
                                           : std::nullopt;
  if (!reflectance) refuse_columns(table, "reflectance");
  SurfaceSpectra spectra{shares_in(table, *reflectance, "reflectance"), std::nullopt};
  if (!transmittance) return spectra;
  spectra.transmittance = shares_in(table, *transmittance, "transmittance");
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const double sum = spectra.reflectance.values[k] + spectra.transmittance->values[k];
    if (sum <= 1.0 + rounding) continue;
    refuse_line(file, table.rows[k].line, fmt::format("reflectance + transmittance = {:g}", sum), "it must be at most 1",
                "correct one of the two; if the column is the absorptance, name it so");
  }
  return spectra;
}

Spectrum read_light_spectrum(const Path& file, SourceFiles* files) {
  SpectralTable table = read_rows(file, files);
  const std::size_t columns = table.rows.front().cells.size();
  order_by_wavelength(table);
  auto column = find_column(table, {"irradiance", "global", "light", "spectral", "energy", "power", "etr"}, {"e"});
  if (!column || *column == table.wavelength) {
    if (columns != 2) refuse_columns(table, "irradiance");
    column = 1 - table.wavelength;
  }
  Spectrum spectrum = spectrum_in(table, *column);
  for (std::size_t k = 0; k < spectrum.values.size(); ++k) {
    if (spectrum.values[k] >= 0.0) continue;
    refuse_line(file, table.rows[k].line, fmt::format("light {:g}", spectrum.values[k]), "it must not be negative",
                "correct the number");
  }
  return spectrum;
}

}  // namespace sunfleck
