// Warns under -Wall and is no error here: neither dpe's -Wextra nor its -Werror is
// about this project.
int Parent(unsigned unused_parameter) {
  int unused_variable;
  return 0;
}
