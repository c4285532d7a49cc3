# Puts each statement of formatted GLSL on one line, and each function of one statement, so that taking out a line takes
# out all of it.
{
  if (text == "" && $0 ~ /^ *($|#|\/\/)/) {
    lines[++count] = $0
    next
  }
  part = $0
  if (text != "") sub(/^ */, " ", part)
  text = text part
  if ($0 !~ /[;{}] *(\/\/.*)?$/) next
  lines[++count] = text
  text = ""
}
END {
  if (text != "") lines[++count] = text
  for (i = 1; i <= count; ++i) {
    if (lines[i] ~ /^[a-z].*\{$/ && lines[i + 2] == "}") {
      print lines[i] lines[i + 1] " }"
      i += 2
    } else {
      print lines[i]
    }
  }
}
