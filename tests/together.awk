# awk -f together.awk FILE ...: test files as one translation unit, which compiles what they share once. Their lines of the
# preprocessor up to the last #include come first; the rest of each file stands in a namespace of its own.
function shown(line, file,    name, beside) {
  if (line !~ /^ *# *include "/) return line
  name = line
  gsub(/^[^"]*"|"[^"]*$/, "", name)
  beside = file
  sub(/[^\/]*$/, "", beside)
  beside = beside name
  if ((getline name <beside) < 0) return line
  close(beside)
  return "#include \"" beside "\""
}
FNR == 1 { ++files; file[files] = FILENAME }
{ text[files, FNR] = $0; lines[files] = FNR }
/^ *# *include/ || (/^ *# *endif/ && FNR == last[files] + 1) { last[files] = FNR }
END {
  for (f = 1; f <= files; ++f) {
    for (n = 1; n <= last[f]; ++n) if (text[f, n] ~ /^ *#/) print shown(text[f, n], file[f])
  }
  for (f = 1; f <= files; ++f) {
    name = file[f]
    sub(/.*\//, "", name)
    sub(/\.cpp$/, "", name)
    print "namespace " name " {"
    print "#line " last[f] + 1 " \"" file[f] "\""
    for (n = last[f] + 1; n <= lines[f]; ++n) print text[f, n]
    print "}"
  }
}
