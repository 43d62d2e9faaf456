# Prints "LINES FILE:LINE" for every function defined at namespace scope (and for every
# TEST). Relies on clang-format: such a function starts in column 0 and ends with the
# next brace in column 0.
FNR == 1 { state = "outside" }

state == "outside" && /^[A-Za-z_~]/ {
  start = FNR
  header = ""
  state = "header"
}

state == "header" {
  header = header " " $0
  is_function = header ~ /\(/ && header !~ /^ (namespace|class|struct|enum|union|using)/
  if ($0 ~ /;$/ || $0 ~ /^template.*>$/) {
    state = "outside"
  } else if ($0 ~ /\}$/) {
    if (is_function) print FNR - start + 1, FILENAME ":" start
    state = "outside"
  } else if ($0 ~ /\{( *\/\/.*)?$/) {
    # A namespace's contents stand in column 0 too.
    state = header ~ /^ (inline )?namespace|^ extern "C" *\{/ ? "outside" : "body"
  }
  next
}

state == "body" && /^\}/ {
  if (is_function) print FNR - start + 1, FILENAME ":" start
  state = "outside"
}
