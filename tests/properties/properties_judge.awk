# properties_judge.awk - the laws. Reads DIR/plan and what the runs left; prints a line for each law that does not hold:
# LAW: what. Every tolerance has its reason beside it. usage: awk -v dir=DIR -f properties_judge.awk DIR/plan
# SPDX-License-Identifier: BSD-3-Clause
function bad(law, text) { print law ": " text; violations++ }
function abs(x) { return x < 0 ? -x : x }
function max(a, b) { return a > b ? a : b }

$1 == "run" { runs[++nruns] = $2; program[$2] = $3 }
$1 == "twin" {
    twins[++ntwins] = $2
    for (a = 0; a < 3; a++) { axis[$2, a] = $(3 + a); sign[$2, a] = $(6 + a); shift[$2, a] = $(12 + a) }
    unit[$2, "L"] = $9; unit[$2, "U"] = $10; unit[$2, "R"] = $11
}
$1 == "know" { know[$2] = $2 == "family" ? $3 " " $4 " " $5 : $3 + 0 }

# Exit code, words, series.csv into value[run, row, column] with names[run, column].
function load(run,    line, n, f, i, file) {
    file = dir "/" run ".code"
    code[run] = (getline line < file) > 0 ? line + 0 : -1
    close(file)
    file = dir "/" run ".out"
    while ((getline line < file) > 0) {
        if (line ~ /\.cfg:[0-9]+: [a-z]+[^ ]*: / || line ~ /\.cfg: [a-z]+[^ ]*: /) refusal[run] = refusal[run] == "" ? line : refusal[run]
        if (line ~ /diverged at|stopped|limit/ && reason[run] == "") reason[run] = line
        if (line ~ /warning/) warned[run] = warned[run] line
    }
    close(file)
    file = dir "/" run "/series.csv"
    while ((getline line < file) > 0) {
        n = split(line, f, ",")
        if (!columns[run]) {
            columns[run] = n
            for (i = 1; i <= n; i++) { names[run, i] = f[i]; at[run, f[i]] = i }
            continue
        }
        rows[run]++
        for (i = 1; i <= n; i++) {
            if (f[i] ~ /nan|inf/ && !(run in sick)) { sick[run] = names[run, i] " at t = " f[1] }
            value[run, rows[run], i] = f[i] + 0
        }
    }
    close(file)
    file = dir "/" run "/summary.json"
    while ((getline line < file) > 0) {
        present[run] = 1
        if (line ~ /: -?(nan|inf)/ && !(run in sick)) sick[run] = line
        gsub(/[",:]/, "", line)
        split(line, f, " ")
        if (!((run, f[1]) in summary)) summary[run, f[1]] = f[2]
    }
    close(file)
}

# What a column's unit is times; scale: what is large for it.
function factor(name, t,    d, l, u, r) {
    d = know["dim"]; l = unit[t, "L"]; u = unit[t, "U"]; r = unit[t, "R"]
    if (name ~ /moment/ && name !~ /momentum/) return r * u * u * l ^ d
    if (name ~ /\[s\]/) return l / u
    if (name ~ /\[J\]/) return r * u * u * l ^ d
    if (name ~ /\[m\^dim\/s\^2\]/) return u * u * l ^ (d - 2)
    if (name ~ /\[kg\]/) return r * l ^ d
    if (name ~ /\[kg m\/s\]/) return r * u * l ^ d
    if (name ~ /\[kg\/m\^3\]/) return r
    if (name ~ /\[Pa\]/) return r * u * u
    if (name ~ /\[m\]/) return l
    if (name ~ /\[m\/s\]/) return u
    if (name ~ /\[1\/s\]/) return u / l
    if (name ~ /\[rad\/s\]/) return u / l
    if (name ~ /\[N(\/m)?\]/) return r * u * u * l ^ (d - 1)
    if (name ~ /\[m\^dim\]/) return l ^ d
    return 1
}
function scale(name,    d, l, u, r, p) {
    d = know["dim"]; l = know["length"]; u = know["speed"]; r = know["rho"]
    p = u * u + know["gravity"] * l
    if (name ~ /mass of level changes|^through/) return know["mass"]
    if (name ~ /^(particles|guards) level/) return 1e5 * max(2, 0.01 * value["base", 1, column("particles [-]")]) # who crosses an edge now, rounding decides
    if (name ~ /moment/ && name !~ /momentum/) return r * p * l ^ d
    if (name ~ /\[J\]/) return know["mass"] * u * u
    if (name ~ /\[m\^dim\/s\^2\]/) return u * u * l ^ (d - 2)
    if (name ~ /\[kg m\/s\]/) return know["mass"] * u
    if (name ~ /\[Pa\]/) return r * p
    if (name ~ /\[m\]/) return l
    if (name ~ /\[rad\/s\]/) return u / l
    if (name ~ /\[rad\]/) return 1
    if (name ~ /\[m\/s\]/) return u
    if (name ~ /\[N(\/m)?\]/) return r * p * l ^ (d - 1)
    if (name ~ /max Mach|error/) return 0.1
    return 0
}
# The column of the twin that answers to the base's; its sign in turned, what to add to it in moved. Bodies show places,
# velocities u v w, and what turns with the hand: rotations rx ry rz, spins ox oy oz, moments; in the plane angle and spin.
function answer(name, t,    a, b, letters, place) {
    turned = 1
    moved = 0
    if (name ~ /^b[0-9] (angle|spin) /) turned = handed(t)
    if (name ~ /^b[0-9]/ && name ~ / [ro][xyz] \[/ || name ~ /moment/ && name !~ /momentum/) turned = handed(t)
    if (match(name, /^(through|level) [xyz]_m/)) { # of a side
        a = index("xyz", substr(name, RLENGTH - 2, 1)) - 1
        b = substr(name, RLENGTH + 1, 2) == "ax"
        if (sign[t, a] < 0) b = !b
        return substr(name, 1, RLENGTH - 3) substr("xyz", axis[t, a] + 1, 1) (b ? "_max" : "_min") substr(name, RLENGTH + 3)
    }
    letters = name ~ /^b[0-9] [uvw] \[/ ? "uvw" : "xyz"
    if (match(name, letters == "uvw" ? " [uvw] [[]" : " [ro]?[xyz] [[]") && name !~ /water up to|^moment z/) {
        place = RSTART + RLENGTH - 3
        a = index(letters, substr(name, place, 1)) - 1
        b = axis[t, a]
        turned *= sign[t, a]
        if (name ~ /^b[0-9] [xyz] \[m\]/) moved = shift[t, b]
        return substr(name, 1, place - 1) substr(letters, b + 1, 1) substr(name, place + 1)
    }
    return name
}
function handed(t,    even) { # det of the motion
    even = axis[t, 0] == 0 && axis[t, 1] == 1 || axis[t, 0] == 1 && axis[t, 1] == 2 || axis[t, 0] == 2 && axis[t, 1] == 0
    return (even ? 1 : -1) * sign[t, 0] * sign[t, 1] * sign[t, 2]
}
# Counts and residuals say how a figure was reached, not what it is.
function compared(name, t) {
    if (name ~ /divergence|put back|gain|paired|odd-even|growth|residual|iteration|krylov|pseudo|water up to|^watch|watch/) return 0
    if (name ~ /\[s\]/) return 0
    if (name ~ /^P[0-9] \[m\]/) return t == "units" || t == "ranks"
    if (name ~ /^moment z/) return t == "units" || t == "ranks" # about the origin
    if (name ~ /^P[0-9] \[Pa\]/) return t != "carried"
    # extremes jump from one particle or cell to another
    if (name ~ /error/ && know["family"] ~ /wave|channel/) return 0 # relative to a start at rest
    if (name ~ /min spacing|max Mach|density|error/) return t == "units"
    return 1
}
# Units change by powers of two: all is equal to rounding, and rounding is the same but for sines of phases. Else sums
# run in another order: particles follow rounding exponentially (a thousandfold in some ten steps), so early
# rows count; cells are solved to fv.tol_pressure = 1e-2 of a step's divergence, by sweeps that know left from right.
# A file of triangles is read to 7 digits, which are others in other units.
function tolerance(t, name) {
    if (t == "units") return program["base"] == "coupled" || (know["dim"] == 3 && know["family"] ~ /solid|floating/) ? 1e-4 : 1e-6
    if (program["base"] == "sph") return 1e-5
    return name ~ /force|moment|\[Pa\]/ ? 0.05 : 0.02
}
function compare(t,    i, j, from, n, row, big, d, worst, what, name, last, s) {
    n = rows["base"] < rows[t] ? rows["base"] : rows[t]
    if (t == "units" && rows["base"] != rows[t]) { bad(t, rows["base"] " steps become " rows[t]); return }
    if (t != "units" && n > (know["refined"] ? 24 : 12)) n = know["refined"] ? 24 : 12 # births and deaths act from row 4 on
    for (i = 3; i <= columns["base"]; i++) {
        name = names["base", i]
        if (!compared(name, t)) continue
        s = answer(name, t)
        if (!((t, s) in at)) { bad(t, "no column " s); continue }
        j = at[t, s]
        big = scale(name)
        worst = 0
        # a sudden start is an impulse, rho U L over the step, of which the tolerance of the pressure leaves noise for some steps
        from = program["base"] == "fv" && t != "units" && t != "ranks" && name ~ /force|moment|\[Pa\]/ ? 8 : 1
        for (row = from; row <= n; row++) {
            if (abs(value["base", row, 1] - value[t, row, 1] / factor("[s]", t)) > 1e-6 * value["base", row, 1]) {
                if (t == "units") { bad(t, "step " row " ends at another time"); return }
                break
            }
            big = max(big, abs(value["base", row, i]))
            d = abs(value["base", row, i] - turned * (value[t, row, j] - moved) / factor(name, t))
            if (d > worst) { worst = d; what = row }
        }
        if (worst > tolerance(t, name) * big)
            bad(t, sprintf("%s: off by %.2g of %.3g in row %d of %d", name, worst, big, what, rows["base"]))
    }
}
# What the summary says of the whole run does not depend on the origin and the axes either; paths part, energies hardly.
function compare_drift(t,    a, b) {
    if (program["base"] != "sph" || t == "carried" || t == "refined" || !(("base", "energy") in summary) || !((t, "energy") in summary)) return
    a = summary["base", "energy"] + 0
    b = summary[t, "energy"] + 0
    if (abs(a - b) > 0.02 + 0.2 * max(abs(a), abs(b))) bad(t, sprintf("drift.energy %.3g becomes %.3g", a, b))
}
# A carried flow has the same energy in its own frame, to the scheme's error: a percent or two where a wave has 12 cells.
function compare_carried(t,    i, K0, K1, P, M, a, x, dV, own) {
    i = at["base", "kinetic energy [J]"]
    if (!i || (know["error"] + 0 == 0 && program["base"] != "sph")) return
    K0 = value["base", rows["base"], i]
    K1 = value[t, rows[t], at[t, "kinetic energy [J]"]]
    M = know["mass"]
    if (("base" SUBSEP "mass [kg]") in at) M = value["base", rows["base"], at["base", "mass [kg]"]]
    for (a = 0; a < know["dim"]; a++) {
        x = substr("xyz", a + 1, 1)
        dV = know["d" x]
        P = M * know["V" x]
        if (("base" SUBSEP "momentum " x " [kg m/s]") in at) P = value["base", rows["base"], at["base", "momentum " x " [kg m/s]"]]
        own += P * dV + 0.5 * M * dV * dV
    }
    if (abs(K1 - own - K0) > 0.05 * M * know["speed"] ^ 2)
        bad(t, sprintf("kinetic energy %.4g J becomes %.4g J in its own frame", K0, K1 - own))
}

# How one run ended.
function ended(run) {
    if (code[run] == 124 || code[run] == 137) bad("ends", run " hangs")
    else if (code[run] == 2 && refusal[run] == "") bad("refuses", run " without file, line and key")
    else if (code[run] == 3 && reason[run] == "") bad("ends", run " diverged without a reason")
    else if (code[run] == 3 && know["standard"]) bad("default", run " stops: " reason[run])
    else if (code[run] != 0 && code[run] != 1 && code[run] != 2 && code[run] != 3) bad("ends", run " with exit code " code[run])
    if (code[run] < 2 && !present[run]) bad("ends", run " without summary.json")
    if (code[run] < 2 && (run in sick)) bad("numbers", run ": " sick[run])
}
function column(name) { return ("base" SUBSEP name) in at ? at["base", name] : 0 }
function last(name) { return column(name) ? value["base", rows["base"], column(name)] : "" }

function laws(    i, k, n, row, K0, sph, lost, drift, slack) {
    n = rows["base"]
    sph = program["base"] == "sph"
    # Births, removals and guards at edges of levels keep mass on average: 0.1 %, and some particles about to cross.
    slack = know["refined"] ? 1e-3 + 8 / value["base", 1, column("particles [-]")] : 0
    k = column("kinetic energy [J]")
    K0 = value["base", 1, k]
    # Sound takes up to Mach^2 = 1 % of the energy and gives it back; cells lose some, their projection is good to 1e-3.
    if (know["unforced"] && !know["still"] && know["gravity"] + 0 == 0 && program["base"] != "coupled")
        for (row = 2; row <= n; row++)
            if (value["base", row, k] > K0 * (1 + slack + (sph ? 0.03 : 1e-3)) + 1e-6 * know["mass"] * know["speed"] ^ 2) {
                bad("energy", sprintf("grows unforced: %.4g J, then %.4g J in row %d of %d", K0, value["base", row, k], row, n))
                break
            }
    if (know["closed"] && know["gravity"] > 0 && sph && summary["base", "energy"] != "null" && know["unforced"] && summary["base", "energy"] > 0.03)
        bad("energy", "grows by " summary["base", "energy"] " in a closed tank")
    # Masses are moved between particles, never made.
    if (know["closed"] && sph) {
        lost = summary["base", "particles_lost"] / value["base", 1, column("particles [-]")]
        drift = last("mass [kg]") / value["base", 1, column("mass [kg]")] - 1 + lost
        if (abs(drift) > 1e-9 + slack + 0.1 * lost) bad("mass", "drifts by " drift) # densities differ by some percent
        if (lost > 0 && warned["base"] !~ /left the region/) bad("mass", "particles are lost without a word")
        if (lost > 0 && !know["open_above"]) bad("mass", summary["base", "particles_lost"] " particles lost")
    }
    if (k = column("volume [m^dim]"))
        if (value["base", 1, k] > 0 && abs(last("volume [m^dim]") / value["base", 1, k] - 1) > 0.01)
            bad("mass", sprintf("volume %.4g becomes %.4g", value["base", 1, k], last("volume [m^dim]")))
    # Pairs push each other: sums cancel to rounding; where shifts carry velocities along (delta, standard) nearly.
    if (know["free_of_walls"] && sph && know["gravity"] + 0 == 0)
        for (i = 0; i < know["dim"]; i++) {
            k = column("momentum " substr("xyz", i + 1, 1) " [kg m/s]")
            if (abs(value["base", n, k] - value["base", 1, k]) > (know["standard"] ? 1e-8 : 0.01) * know["mass"] * know["speed"] + slack * abs(value["base", 1, k]) + (slack > 0 ? 0.01 * know["mass"] * know["speed"] : 0)) {
                bad("momentum", sprintf("changes from %.3g to %.3g kg m/s (mass x speed %.3g)", value["base", 1, k], value["base", n, k], know["mass"] * know["speed"]))
                break
            }
        }
    # Particles settle on walls within some thousandths of c, and say so where they are too few; cells are at rest to the
    # solver's tolerance.
    if (know["still"] && warned["base"] !~ /the flow there is noise/) {
        if (sph && last("max Mach [-]") > 5e-3) bad("rest", sprintf("|u| = %.2g c0 at the end", last("max Mach [-]")))
        if (program["base"] == "fv" && last("largest velocity [m/s]") > 1e-6 * know["speed"]) bad("rest", sprintf("|u| = %.2g of %.2g m/s at the end", last("largest velocity [m/s]"), know["speed"]))
    }
    # A uniform stream is its own solution (particles: 1 % by sound; their number changes by whole rows).
    # Half as many cells a wave as the coarsest case of the table in README.md: ten times its error.
    if (know["error"] > 0 && summary["base", "velocity_l2"] + 0 > know["error"] && !("base" in warned))
        bad("error", "of " summary["base", "velocity_l2"] " without a word")
    k = column("kinetic energy [J]")
    i = column("mass [kg]")
    if (know["stream"] > 0 && sph)
        for (row = 2; row <= n; row++)
            if (abs(value["base", row, k] / K0 * value["base", 1, i] / value["base", row, i] - 1) > 0.02) {
                bad("error", sprintf("uniform stream: energy a mass changes by %.2g in row %d of %d", value["base", row, k] / K0 * value["base", 1, i] / value["base", row, i] - 1, row, n))
                break
            }
    if (know["stream"] > 0 && abs(last("largest velocity [m/s]") / know["stream"] - 1) > 1e-4 && program["base"] == "fv")
        bad("error", sprintf("uniform stream of %.4g m/s becomes %.4g m/s", know["stream"], last("largest velocity [m/s]")))
}

END {
    for (r = 1; r <= nruns; r++) { load(runs[r]); ended(runs[r]) }
    if (code["base"] < 2 && rows["base"] > 0) laws()
    for (k = 1; k <= ntwins; k++) {
        t = twins[k]
        if (code[t] == code["base"] && code["base"] < 2) { if (t == "carried") compare_carried(t); else { compare(t); compare_drift(t) } }
        else if (t == "ranks" && refusal[t] refusal["base"] ~ /ranks cannot share/) continue # fewer cells than ghosts
        else if (code[t] != code["base"] && !(code[t] > 100 || code["base"] > 100)) bad(t, "exit code " code["base"] " becomes " code[t] " " refusal[t] reason[t])
    }
    if (code["base"] == 2 && !violations) print "refused: " refusal["base"]
    exit violations > 0
}
