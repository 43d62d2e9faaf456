# Turns the comments of the public headers into ones that Doxygen reads: "//" before a
# declaration, "// ..." behind one (also continued below it), and equations, which are
# indented, as they stand. Headers of the C interface: /* before a declaration.
BEGIN { verbatim = 0; trailing = 0; list = 0; in_c = 0 }

# C: every comment is one; those behind a declaration say of what is before.
in_c || /^ *\/\*/ || /[;,{)a-z0-9] +\/\* / {
  line = $0
  start = ""
  if (!in_c) {
    match(line, /\/\*/)
    start = substr(line, 1, RSTART - 1)
    behind = start ~ /[^ ]/
    line = substr(line, RSTART + 2)
    start = start (behind ? "/**<" : "/**")
    if (FNR == 1) start = start " @file\n *"
    in_c = 1
  }
  finish = ""
  if (match(line, /\*\//)) {
    finish = substr(line, RSTART)
    line = substr(line, 1, RSTART - 1)
    in_c = 0
  }
  star = ""
  if (start == "" && match(line, /^ *\* ?/)) {
    star = substr(line, 1, RLENGTH)
    line = substr(line, RLENGTH + 1)
  }
  print start star escape(line) finish
  next
}

function close_verbatim() {
  if (verbatim) print indent "/// @endverbatim"
  verbatim = 0
}

# HTML, markdown and links are not meant, except for code between backticks.
function plain(text) {
  gsub(/[\\<>&#%|*@$]|::/, "\\\\&", text)
  sub(/^ \\@/, " @", text)
  return text
}

function escape(text, parts, n, i, result) {
  n = split(text, parts, "`")
  if (n % 2 == 0) {
    gsub(/`/, "'", text)
    return plain(text)
  }
  for (i = 1; i <= n; ++i) {
    result = result (i > 1 ? "`" : "") (i % 2 ? plain(parts[i]) : parts[i])
  }
  return result
}

FNR == 1 { file_comment = 1 }

# A comment line.
/^ *\/\// {
  match($0, /\/\//)
  indent = substr($0, 1, RSTART - 1)
  text = substr($0, RSTART + 2)
  if (trailing == RSTART) {  # goes on with the comment behind the declaration above
    print indent "///< " escape(text)
    next
  }
  trailing = 0
  if (file_comment == 1) { print "/// @file"; file_comment = 2 }
  if (text ~ /^ @/ || text ~ /^ - /) list = 1
  if (text ~ /^ *$/ || text ~ /^ [^ ]/ && text !~ /^ [@-]/) list = 0
  if (!list && text ~ /^   /) {
    if (!verbatim) print indent "/// @verbatim"
    verbatim = 1
    print indent "///" text
    next
  }
  if (text ~ /^ *$/ && verbatim) { print indent "///"; next }
  close_verbatim()
  print indent "///" escape(text)
  next
}

{
  close_verbatim()
  if (file_comment) file_comment = 3
  trailing = 0
}

# Code with a comment behind it.
/[^ :"].*[;,{)] +\/\/ / {
  match($0, /[;,{)] +\/\/ /)
  place = RSTART + RLENGTH - 3
  print substr($0, 1, place - 1) "///<" escape(substr($0, place + 2))
  trailing = place
  next
}

{ print }
