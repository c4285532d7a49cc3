# Puts each statement of formatted GLSL on one line, so that a line can be taken out as a whole.
:again
/^ *$/b
/^ *#/b
/^ *\/\//b
/[;{}] *\(\/\/.*\)\{0,1\}$/b
N
s/\n */ /
b again
