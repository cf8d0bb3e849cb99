# Reduces the output of Assumptions.v to the axioms' names, sorted, one a line below each
# theorem; the primitive integers are named by their module.
function flush(   i, n, k, t) {
  if (title == "") return
  print title
  n = 0
  for (k in seen) list[++n] = k
  for (i = 2; i <= n; i++)
    for (j = i; j > 1 && list[j] < list[j - 1]; j--) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
  for (i = 1; i <= n; i++) print "  " list[i]
  delete seen
}
/^== / { flush(); title = $2; next }
/^Axioms:/ { next }
/^Closed under the global context/ { seen["none"] = 1; next }
/^[A-Za-z_]/ {
  name = $1
  if (name ~ /^(PrimInt63|Uint63)\./) sub(/\..*/, "", name)
  seen[name] = 1
}
END { flush() }
