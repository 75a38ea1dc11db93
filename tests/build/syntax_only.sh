# syntax_only.sh COMPILER ARGUMENTS...: compiles a unit for its errors and warnings; the object file is empty.
object=
for argument; do
  case $argument in *.o) object=$argument ;; esac
done
[ -z "$object" ] || set -- "$@" -fsyntax-only
"$@" && { [ -z "$object" ] || : >"$object"; }
