// Tables as text: CSV for programs, Markdown for people.
#ifndef DPE_TOOLS_EXPERIMENTS_OUTPUT_TABLES_H_
#define DPE_TOOLS_EXPERIMENTS_OUTPUT_TABLES_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// RFC 4180 with line feeds: fields with commas, quotes or line breaks are quoted,
// quotes doubled.
std::string TableToCsv(const Table& table);

// Pipes are escaped, line breaks become <br>. Columns of numbers are aligned to the
// right. The caption stands before the table.
std::string TableToMarkdown(const Table& table);

// Every column that any of the rows has, in the order of first appearance, those of
// the executor last; an absent value is empty. Numbers have as many digits as reading
// them back needs.
Table TableOfRows(const std::string& name, const std::vector<Row>& rows);

// "0.0123" with that many digits, in exponents where that is shorter to read; "" for
// not-a-number.
std::string FormatNumber(double value, int digits = 3);

// The value of a key for a table cell: FormatNumber for fractions, text as it is, ""
// if absent.
std::string FormatValue(const Row& row, const std::string& key, int digits = 3);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_OUTPUT_TABLES_H_
