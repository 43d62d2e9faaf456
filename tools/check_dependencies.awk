# Prints one line per use of something that the file's folder ("room") may not use.
# Called by check_style.sh with all source files, and with their names in `sources`.
#
# Dependencies point one way: engine <- estimation <- everything else.
BEGIN {
  count = split(sources, names, "\n")
  for (i = 1; i <= count; ++i) {
    position = index(names[i], "/src/")
    if (position > 0 && names[i] ~ /\.h$/) {
      owner = substr(names[i], 1, position - 1)
      rooms_with_private_headers[owner] = 1
      is_private[owner "/" substr(names[i], position + 5)] = 1
    }
    exists[names[i]] = 1
  }
}

function complain(what) {
  printf "%s:%d: %s\n", FILENAME, FNR, what
}

# True if `header` is a private header of `room`.
function private_in(room, header) {
  return (room "/" header) in is_private
}

function check_private(header,    other) {
  if (header ~ /(^|\/)src\// || header ~ /^\.\.\//) {
    complain("include by path: " header " (public headers are dpe/<room>/..., private " \
             "ones are seen inside their own room only)")
    return
  }
  if ((folder "/" header) in exists) return
  if (FILENAME ~ /\/include\// && private_in(room, header))
    complain("a public header includes a private one: " header)
  if (private_in(unit_room, header)) return
  for (other in rooms_with_private_headers)
    if (private_in(other, header))
      complain("private header of " other ": " header)
}

function check_include(header) {
  if (header ~ /^ceres\// && room != "estimation" && !is_test &&
      !(header == "ceres/jet.h" && FILENAME ~ /^engine\/src\//))
    complain("Ceres belongs to estimation (the engine may use ceres/jet.h in src/)")
  if (header ~ /^(vulkan|GLFW)\/|^volk\.h|^vk_/ && unit_room != "viewer")
    complain("Vulkan and GLFW belong to viewer")
  if (header ~ /^nlohmann\// && FILENAME !~ /_io\.(h|cc)$/ && !is_test)
    complain("JSON belongs in files named *_io")
  if (header ~ /^gflags\// && !is_program)
    complain("flags belong to tools")
  if (room == "engine" && header ~ /^dpe\// && header !~ /^dpe\/engine\//)
    complain("the engine includes nothing of other rooms: " header)
  if (room == "estimation" && header ~ /^dpe\// && header !~ /^dpe\/(engine|estimation)\//)
    complain("estimation includes nothing but itself and the engine: " header)
  check_private(header)
}

FNR == 1 {
  split(FILENAME, part, "/")
  room = part[1]
  is_test = room == "tests"
  # The viewer's program parses flags and prints as those in tools/ do.
  is_program = room == "tools" || FILENAME == "viewer/main.cc"
  # A unit test sees what its room sees. Benchmarks see what the engine sees: they measure
  # its matrices.
  unit_room = is_test ? part[2] : room
  if (FILENAME ~ /^tests\/benchmarks\//) unit_room = "engine"
  folder = FILENAME
  sub(/\/[^\/]*$/, "", folder)
}

/^[ \t]*#[ \t]*include/ {
  header = $0
  sub(/^[^<"]*[<"]/, "", header)
  sub(/[>"].*$/, "", header)
  check_include(header)
}

# Examples are programs too.
!is_program && !is_test && FILENAME !~ /^[a-z_]+\/examples\// {
  code = $0
  sub(/\/\/.*/, "", code)
  if (code ~ /std::(cout|cerr|clog)|(^|[^a-z_])(printf|puts|putchar)\(|(stdout|stderr)/)
    complain("only the programs in tools/ print; a library returns a report")
}
