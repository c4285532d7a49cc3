# Every place of C++ sources where an operator may be swapped for another, in an order that the seed alone decides.
# awk -v seed=1 -f swaps.awk FILE...; a line each: FILE, line, column, what stands there, what is to stand there; between tabs.
# The house's layout is what tells operators from brackets, pointers and signs: a binary operator has a space on both sides.
BEGIN {
  with["+"] = "-"; with["-"] = "+"; with["*"] = "/"; with["/"] = "*"
  with["+="] = "-="; with["-="] = "+="; with["*="] = "/="; with["/="] = "*="
  with["<"] = "<= >"; with["<="] = "< >="; with[">"] = ">= <"; with[">="] = "> <="
  with["=="] = "!="; with["!="] = "=="; with["&&"] = "||"; with["||"] = "&&"
  with["min"] = "max"; with["max"] = "min"; with["sin"] = "cos"; with["cos"] = "sin"
  with["Min"] = "Max"; with["Max"] = "Min"; with["Add"] = "Sub"; with["Sub"] = "Add"  # of vectors (Highway)
  places = 0
  random = seed % 2147483646 + 1
}

# Park and Miller (1988): every product is exact in a double.
function below(n) {
  random = (random * 16807) % 2147483647
  return int((random - 1) / 2147483646 * n)
}

function place(column, what) {
  ++places
  file[places] = FILENAME; row[places] = FNR; at[places] = column; before[places] = what
}

FNR == 1 { in_comment = in_raw = in_directive = 0 }

{
  text = $0
  if (in_directive || (!in_comment && !in_raw && text ~ /^[ \t]*#/)) { in_directive = text ~ /\\$/; next }
  # What asks the compiler, and what release builds leave out.
  quiet = text ~ /^[ \t]*(template|using|static_assert|assert)[ (<]/ || text ~ /operator[-+*\/<>=!&|]/
  i = 1; n = length(text); last = ""
  while (i <= n) {
    rest = substr(text, i)
    if (in_comment) { k = index(rest, "*/"); if (!k) break; i += k + 1; in_comment = 0; continue }
    if (in_raw) { k = index(rest, ")" raw_end "\""); if (!k) break; i += k + length(raw_end) + 1; in_raw = 0; last = "\""; continue }
    c = substr(rest, 1, 1); two = substr(rest, 1, 2)
    if (c == " " || c == "\t") { ++i; continue }
    if (two == "//") break
    if (two == "/*") { in_comment = 1; i += 2; continue }
    if (match(rest, /^(u8|u|U|L)?R"[^(]*\(/)) {
      raw_end = substr(rest, 1, RLENGTH - 1); sub(/^[^"]*"/, "", raw_end); in_raw = 1; i += RLENGTH; continue
    }
    if (c == "\"" || c == "'") {
      for (++i; i <= n && substr(text, i, 1) != c; ++i) if (substr(text, i, 1) == "\\") ++i
      ++i; last = c; continue
    }
    if (match(rest, /^\.?[0-9]([eEpP][-+]|[0-9a-zA-Z_.'])*/)) { i += RLENGTH; last = "0"; continue }
    if (match(rest, /^[A-Za-z_][A-Za-z_0-9]*/)) {
      word = substr(rest, 1, RLENGTH); after = substr(rest, RLENGTH + 1, 1)
      if (!quiet && word in with && last == "::" && (after == "(" || after == "<")) place(i, word)
      i += RLENGTH; last = word; continue
    }
    op = c
    if (match(rest, /^(<<=|>>=|<=>|->\*|\.\.\.|->|::|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|\/=|%=|&=|\|=|\^=)/)) op = substr(rest, 1, RLENGTH)
    next_char = substr(rest, length(op) + 1, 1)
    spaced = (i == 1 || substr(text, i - 1, 1) == " ") && (next_char == "" || next_char == " ")
    if (!quiet && spaced && op in with && last != "\"") place(i, op)
    i += length(op); last = op
  }
}

END {
  for (i = 1; i <= places; ++i) order[i] = i
  for (i = places; i > 1; --i) { k = below(i) + 1; swap = order[i]; order[i] = order[k]; order[k] = swap }
  for (i = 1; i <= places; ++i) {
    k = order[i]
    choices = split(with[before[k]], choice, " ")
    printf "%s\t%d\t%d\t%s\t%s\n", file[k], row[k], at[k], before[k], choice[below(choices) + 1]
  }
}
