#include "experiments/output/tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace dpe::experiments {
namespace {

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string CsvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (size_t f = 0; f < fields.size(); ++f) {
    line += (f > 0 ? "," : "") + CsvField(fields[f]);
  }
  return line + "\n";
}

std::string MarkdownCell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') {
      cell += "\\|";
    } else if (c == '\n') {
      cell += "<br>";
    } else if (c != '\r') {
      cell += c;
    }
  }
  return cell;
}

std::string MarkdownLine(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + MarkdownCell(cell) + " |";
  return line + "\n";
}

bool IsNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

bool IsNumeric(const Table& table, size_t column) {
  bool has_number = false;
  for (const std::vector<std::string>& row : table.cells) {
    if (column >= row.size() || row[column].empty() || row[column] == "–") continue;
    if (!IsNumber(row[column])) return false;
    has_number = true;
  }
  return has_number;
}

bool IsOfExecutor(const std::string& column) {
  return column == "outcome" || column == "reason" || column == "wall_s" ||
         column == "cpu_s" || column == "peak_mib";
}

std::string ExactText(const Record::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return FormatNumber(*number, 17);
  }
  std::ostringstream text;
  text << std::boolalpha;
  std::visit([&](const auto& v) { text << v; }, value);
  return text.str();
}

}  // namespace

std::string TableToCsv(const Table& table) {
  std::string text = CsvLine(table.columns);
  for (const std::vector<std::string>& row : table.cells) text += CsvLine(row);
  return text;
}

std::string TableToMarkdown(const Table& table) {
  std::string text = table.caption.empty() ? "" : table.caption + "\n\n";
  text += MarkdownLine(table.columns) + "|";
  for (size_t c = 0; c < table.columns.size(); ++c) {
    text += IsNumeric(table, c) ? "---:|" : "---|";
  }
  text += "\n";
  for (const std::vector<std::string>& row : table.cells) text += MarkdownLine(row);
  return text;
}

Table TableOfRows(const std::string& name, const std::vector<Row>& rows) {
  Table table;
  table.name = name;
  for (const Row& row : rows) {
    for (const auto& [key, value] : row.values()) {
      const auto& columns = table.columns;
      if (std::find(columns.begin(), columns.end(), key) == columns.end()) {
        table.columns.push_back(key);
      }
    }
  }
  // What every row has stands last.
  std::stable_partition(table.columns.begin(), table.columns.end(),
                        [](const std::string& c) { return !IsOfExecutor(c); });
  for (const Row& row : rows) {
    std::vector<std::string> cells;
    for (const std::string& column : table.columns) {
      const Record::Value* value = row.Find(column);
      cells.push_back(value == nullptr ? "" : ExactText(*value));
    }
    table.cells.push_back(std::move(cells));
  }
  return table;
}

std::string FormatNumber(double value, int digits) {
  if (!std::isfinite(value)) return "";
  char text[40];
  std::snprintf(text, sizeof(text), "%.*g", digits, value);
  // The shortest text that means the same number, where all digits are asked for.
  for (int fewer = 6; digits >= 17 && fewer < 17; ++fewer) {
    std::snprintf(text, sizeof(text), "%.*g", fewer, value);
    if (std::strtod(text, nullptr) == value) break;
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
  }
  return text;
}

std::string FormatValue(const Row& row, const std::string& key, int digits) {
  const Record::Value* value = row.Find(key);
  if (value == nullptr) return "";
  if (const auto* number = std::get_if<double>(value)) {
    return FormatNumber(*number, digits);
  }
  return ExactText(*value);
}

}  // namespace dpe::experiments
