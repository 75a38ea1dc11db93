# awk -v page=docs/events.md -v root=PROJECT -f snippets.awk FILE: a translation unit of the C++ of a page of the
# documentation.
#
# A ```cpp block is the body of a function, or, with `int main()` in it, a program. What a ``` block without a language
# right behind it has is what the function must print; without one it must print nothing. ```json and ```xml blocks are
# the texts `json_1`, `json_2`, `xml_1` ... Lines `#include` go to the top. What else a block needs stands in comments that
# readers of the page do not see:
#
#   <!-- snippet             the lines up to --> stand in front of the next block, in its function
#   <!-- snippet: outside    they stand in no function; without lines, <!-- snippet: outside -->, the next block does
#   <!-- snippet: continued  they, and the next block, belong to the function of the block before
#   <!-- snippet: after      they belong to the block before
#   <!-- snippet: from FILE -->   the next block stands in this file of the project, which is compiled elsewhere
#
function add(text) { body = body text "\n" }
function here() { add("#line " NR + 1 " \"" page "\"") }

function open_function(line) {
  close_function()
  name = "snippet_" line
  open = 1
  add("static void " name "() {")
}
function close_function() {
  if (open) add("}")
  if (name != "") add("static const docs::snippet " name "_entry(\"" page ":" substr(name, 9) "\", " name ", R\"---(" output ")---\");")
  open = 0
  name = output = ""
}

function add_code(line) {
  if (line ~ /^#include/) {
    if (!(line in included)) includes = includes line "\n"
    included[line] = 1
    line = ""
  }
  add(line)
}

# What stands in comments.
hidden && /^-->/ { hidden = 0; next }
hidden { add_code($0); next }
/^<!-- snippet/ {
  how = $0
  sub(/^<!-- snippet:? */, "", how)
  sub(/ *(-->)?$/, "", how)
  if (how ~ /^from /) { excerpt = substr(how, 6); next }
  if (how == "outside") close_function()
  else if (how == "") open_function(NR)
  else if (how != "continued" && how != "after") { print page ":" NR ": '" how "'?" > "/dev/stderr"; exit 1 }
  hidden = $0 !~ /-->$/
  if (how == "" || how == "continued") place = "continued"
  else if (how == "outside") place = hidden ? "" : "outside"
  here()
  next
}

# Blocks.
/^```/ && fence == "" {
  fence = $0 == "```" ? "text" : substr($0, 4)
  if (fence == "text" && may_print) fence = "output"
  is_text = fence == "json" || fence == "xml"
  if (is_text) add("[[maybe_unused]] static const char* const " fence "_" ++texts[fence] " = R\"---(")
  first = NR
  block = ""
  is_program = may_print = 0
  next
}
/^```/ {
  if (fence == "cpp" && excerpt != "") check_excerpt()
  else if (fence == "cpp") add_block()
  if (is_text) add(")---\";")
  is_text = 0
  may_print = fence == "cpp"
  fence = ""
  next
}
fence == "cpp" {
  if (sub(/^int main\(\) \{/, "void run() {")) is_program = 1
  block = block $0 "\n"
  next
}
is_text { add($0); next }
fence == "output" { output = output $0 "\n"; next }
fence == "" && NF { may_print = 0 }

function check_excerpt(    file, line, text) {
  file = root "/" excerpt
  while ((getline line < file) > 0) text = text line "\n"
  close(file)
  if (!index(text, block)) { print page ":" first ": this is not in " excerpt > "/dev/stderr"; exit 1 }
  excerpt = ""
}
function add_block(    lines, count, i) {
  if (place == "continued" && name == "") { print page ":" NR ": continues nothing" > "/dev/stderr"; exit 1 }
  if (is_program) {
    close_function()
    add("namespace program_" first " {")
  } else if (place == "") {
    open_function(first)
  }
  add("#line " first + 1 " \"" page "\"")
  count = split(block, lines, "\n")
  for (i = 1; i < count; ++i) add_code(lines[i])
  if (is_program) {
    name = "snippet_" first
    add("}\nstatic constexpr auto& " name " = program_" first "::run;")
  }
  place = ""
}

END {
  close_function()
  id = page
  gsub(/[^A-Za-z0-9]/, "_", id)
  printf "#include \"docs/snippet.hpp\"\n%snamespace %s {\n%s}\n", includes, id, body
}
