#!/bin/sh
# No key is passed over in silence: in small scenes of every kind each key of the table is set to
# another value; the run is refused (exit code 2), or what it writes differs. A key of sph --params
# that has no value below is a failure, too. usage: tests/jobs/unused.sh [BUILD] [MODE...]; by default some
# modes, "all" for each. SPDX-License-Identifier: BSD-3-Clause
tmp=$(mktemp -d "${TMPDIR:-/tmp}/unused.XXXXXX")
. "$(dirname "$0")/lib.sh"
[ $# -gt 0 ] && shift
trap 'rm -rf "$tmp"' EXIT
passed=0 refused=0

# Plain groups: what each key is set to. In lists: the first wall, body, shape, probe.
values='
time.end 0.043
fluid.rho 700
fluid.nu 0.02
fluid.gravity (0.3,-7)
fluid.central 2
domain.dim 3
domain.min (-1.2,-0.8)
domain.max (1.2,1.2)
domain.periodic (true,false)
initial.field couette
initial.U 1.7
initial.L 0.7
initial.velocity (0.1,0.2)
initial.amplitude 0.03
initial.L_z 0.5
initial.level 0.9
initial.seed ((0.9,0.9,0.9))
initial.crest 0.3
coupling.steps 7
coupling.transition 0.15
coupling.buffer 0.15
coupling.overlap 0.15
coupling.memory 3
coupling.keep_mass false
coupling.mapping shepard
coupling.interpolation linear
coupling.in_time linear
coupling.deadline 7
output.every 0.003
output.snapshots true
output.series 2
output.checkpoint 0.002
sph.dx 0.05
sph.R_dx 3
sph.c0 17
sph.gamma 1
sph.scheme standard
sph.riemann exact
sph.limiter minmod
sph.transport none
sph.surface_shift beta
sph.viscosity monaghan
sph.low_dissipation false
sph.dissipation 0.4
sph.damper 0.4
sph.alpha 0.05
sph.delta 0.1
sph.background true
sph.integrator rk4
sph.cfl 0.2
sph.cfl_viscous 0.0001
sph.box ((-1,-1),(1,0.5))
sph.free ((-1,-1),(1,0.5))
sph.box_velocity (0.1,0)
sph.box_follows b
sph.outer exact
sph.density_limit 1e-6
sph.walls ghosts
sph.wall_integrals clipped
sph.births vertices
sph.surface yes
sph.packing 7
sph.noise 0.1
sph.extrema (-0.3,0.2,-0.2)
walls.side x_max
walls.points ((-1,-0.5),(1,-0.5))
walls.closed true
walls.kind no_slip
walls.velocity (0.2,0)
walls.friction 0.05
walls.beach 0.2
walls.beach_period 0.7
gauges.name other
gauges.probes "a b"
gauges.from 0.01
gauges.period 0.3
waves.kind sea
waves.height 0.12
waves.length 1.2
waves.period 0.8
waves.depth 0.9
waves.direction 10.0
waves.at (0.2,0.1)
waves.start 1.0
waves.current 0.1
waves.closed false
waves.zone 0.4
waves.peak 2.0
waves.repeat 50.0
waves.seed 3
waves.order 1
waves.evolve hos
waves.file nowhere.swd
waves.spread 8.0
walls.profile "parabolic"
walls.pressure 100.0
walls.carried true
walls.level 0.3
walls.level_file "nowhere.txt"
walls.discharge_file "nowhere.txt"
walls.discharge 0.02
walls.mesh "other.stl"
walls.outline "other.csv"
walls.scale 0.9
walls.rotate (0,0,20)
walls.translate (0.05,0,0)
walls.weld 5
walls.fluid_side "outside"
walls.flip true
walls.thin true
bodies.name "other"
bodies.mesh "other.stl"
bodies.outline "other.csv"
bodies.scale 0.9
bodies.rotate (0,0,20)
bodies.translate (0.05,0,0)
bodies.weld 5
bodies.thin true
bodies.points ((-0.3,-0.4),(-0.3,-0.1),(0.2,-0.1),(0.2,-0.4))
bodies.kind "no_slip"
bodies.centre (0.1,0.1)
bodies.velocity (0.1,0)
bodies.spin 0.5
bodies.motion "nowhere.txt"
bodies.force (3,4)
bodies.free true
bodies.density 700
bodies.mass 7
bodies.inertia 7
bodies.lock "y"
bodies.release 0.01
bodies.force_rule "average"
bodies.load (3,4)
bodies.torque 5
bodies.lines ({from=(-0.2,0.2);to=(-0.2,0.8);damping=3.0;})
bodies.hinge {at=(0.5,0.1);}
bodies.slider {axis=(1,1);}
bodies.contact {gap=2.0;}
bodies.motion.kind "polynomial"
bodies.motion.file "nowhere.txt"
bodies.motion.axis "y"
bodies.motion.amplitude 0.02
bodies.motion.period 0.2
bodies.motion.phase 0.3
bodies.motion.coefficients (1,2)
bodies.motion.from 0.01
bodies.motion.until 0.02
bodies.motion.ramp 0.02
bodies.motion.absorb true
bodies.lines.from (0.2,0.2)
bodies.lines.to (0.2,0.7)
bodies.lines.body "b"
bodies.lines.stiffness 300
bodies.lines.length 0.3
bodies.lines.damping 30
bodies.lines.pull_only true
bodies.hinge.at (0.3,0.2)
bodies.hinge.axis (0,1,1)
bodies.hinge.stiffness 300
bodies.hinge.damping 30
bodies.hinge.at_rest 0.4
bodies.slider.axis (1,1)
bodies.contact.restitution 0.6
bodies.contact.friction 0.6
bodies.contact.gap 1.2
shapes.form "disc"
shapes.box ((-1,-1),(0.3,0.2))
shapes.points ((-1,-1),(1,-1),(0,0.5))
shapes.centre (0.1,0.1)
shapes.radius 0.5
shapes.level 0.3
shapes.mesh "other.stl"
shapes.outline "other.csv"
shapes.scale 0.7
shapes.rotate (0,20,0)
shapes.translate (0.3,0,0)
shapes.weld 5
shapes.hole true
shapes.velocity (0.2,0)
probes.name "other"
probes.kind "level"
probes.at (0.2,-0.7)
probes.to (0.3,-0.7)
probes.radius 0.5
probes.body "b"
apr.levels 3
apr.margin 2.0
apr.around 4
apr.particles 6000
apr.method weights
apr.guards shepard
apr.local_steps true
apr.unshifted_finest true
apr.regions ({min=(-0.8,-0.8);max=(0.7,0.7);})
apr.criteria ({kind="vorticity";above=0.02;})
apr.regions.level 1
apr.regions.shape "sphere"
apr.regions.min (-0.4,-0.35)
apr.regions.max (0.4,0.45)
apr.regions.centre (0.1,0.1)
apr.regions.radius 0.5
apr.regions.body "b"
apr.regions.wall 1
apr.regions.offset 0.4
apr.regions.velocity (0.3,0)
apr.regions.motion ({kind="harmonic";axis="x";amplitude=0.02;period=0.2;})
apr.regions.follow "peak"
apr.regions.along "x"
apr.regions.pressure 10.0
apr.regions.motion.kind "polynomial"
apr.regions.motion.file "nowhere.txt"
apr.regions.motion.axis "y"
apr.regions.motion.amplitude 0.03
apr.regions.motion.period 0.3
apr.regions.motion.phase 0.3
apr.regions.motion.coefficients (1,2)
apr.regions.motion.from 0.01
apr.regions.motion.until 0.02
apr.regions.motion.ramp 0.02
apr.regions.motion.absorb true
apr.criteria.level 2
apr.criteria.kind "pressure"
apr.criteria.above 0.055
apr.criteria.distance 2
'
# Where a run is written (checkpoint_wall: by the clock; fields: in snapshots, which are off here; tests/jobs/bad_input.sh has
# the words of it), and what judges it.
exceptions='output.checkpoint_wall output.fields'

head='format = 1;
time:    { end = 0.04; };
output:  { series = 1; snapshots = false; };'
box='domain:  { dim = 2; min = (-1, -1); max = (1, 1); };
walls: ( { side = "y_min"; #walls
 }, { side = "x_min"; }, { side = "x_max"; }, { side = "y_max"; } );'
open='domain:  { dim = 2; min = (-1, -1); max = (1, 1); };
walls: ( { side = "y_min"; #walls
 }, { side = "x_min"; }, { side = "x_max"; } );'
probe='probes: ( { name = "p"; at = (0.1, -0.9); #probes
 } );'
scene() {
    case $1 in
    vortices) echo 'fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.1; };' ;;
    delta) echo 'fluid: { rho = 1.0; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.1; scheme = "delta"; };' ;;
    dam) echo "$open
$probe"'
fluid: { rho = 1000.0; gravity = (0, -9.81); };
initial: { U = 3.0; };
shapes: ( { form = "box"; box = ((-1, -1), (0, 0)); #shapes
 } );
sph: { dx = 0.1; c0 = 30.0; };' ;;
    body) echo "$box"'
fluid: { rho = 1000.0; gravity = (0, -9.81); nu = 0.01; };
initial: { U = 3.0; };
bodies: ( { name = "b"; points = ((-0.2, -0.2), (-0.2, 0.2), (0.2, 0.2), (0.2, -0.2)); #bodies
 } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };' ;;
    float) echo "$box"'
fluid: { rho = 1000.0; gravity = (0, -9.81); nu = 0.01; };
initial: { U = 3.0; };
shapes: ( { form = "below"; level = 0.0; } );
bodies: ( { name = "b"; points = ((-0.2, -0.2), (-0.2, 0.2), (0.2, 0.2), (0.2, -0.2)); free = true; density = 600.0; lock = "x"; #bodies
 motion = ( { kind = "harmonic"; axis = "x"; amplitude = 0.01; period = 0.1; #motion
 } );
 lines = ( { from = (-0.2, 0.2); to = (-0.2, 0.8); stiffness = 200.0; length = 0.65; #lines
 } );
 } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };' ;;
    hinge) echo "$box"'
fluid: { rho = 1000.0; gravity = (0, -9.81); nu = 0.01; };
initial: { U = 3.0; };
shapes: ( { form = "below"; level = 0.0; } );
bodies: ( { name = "b"; points = ((-0.2, -0.2), (-0.2, 0.2), (0.2, 0.2), (0.2, -0.2)); free = true; density = 600.0; #bodies
 hinge = { at = (0.5, 0.1); stiffness = 200.0; #hinge
 };
 } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };' ;;
    touch) echo "$box"'
fluid: { rho = 1000.0; nu = 0.01; };
initial: { U = 3.0; };
bodies: ( { name = "b"; points = ((-0.2, -0.845), (-0.2, -0.5), (0.2, -0.5), (0.2, -0.845)); free = true; density = 600.0; velocity = (0.5, -2.0); #bodies
 slider = { axis = (0, 1); #slider
 };
 contact = { restitution = 0.3; #contact
 };
 }, { name = "c"; points = ((0.5, 0.5), (0.5, 0.8), (0.8, 0.8), (0.8, 0.5)); free = true; mass = 50.0; inertia = 3.0; centre = (0.65, 0.65); } );
sph: { dx = 0.1; c0 = 30.0; packing = 5; };' ;;
    box) echo 'fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "uniform"; velocity = (1, 0.5); };
sph: { dx = 0.04; R_dx = 2.0; box = ((-0.8, -0.8), (0.8, 0.8)); };' ;;
    channel) echo 'fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { field = "uniform"; velocity = (1, 0); };
walls: ( { side = "x_min"; kind = "inflow"; velocity = (1, 0); #walls
 }, { side = "x_max"; kind = "outflow"; }, { side = "y_min"; }, { side = "y_max"; } );
sph: { dx = 0.1; R_dx = 2.0; };' ;;
    cube) echo 'fluid: { rho = 1000.0; gravity = (0, 0, -9.81); };
domain: { dim = 3; min = (-1, -1, -1); max = (1, 1, 1); };
walls: ( { side = "z_min"; #walls
 }, { side = "x_min"; }, { side = "x_max"; }, { side = "y_min"; }, { side = "y_max"; } );
initial: { U = 3.0; };
shapes: ( { form = "below"; level = 0.0; #shapes
 } );
sph: { dx = 0.2; R_dx = 2.5; c0 = 30.0; };' ;;
    mesh) echo 'fluid: { rho = 1000.0; gravity = (0, 0, -9.81); nu = 0.01; };
domain: { dim = 3; min = (-1, -1, -1); max = (1, 1, 1); };
walls: ( { mesh = "tank.stl"; #walls
 } );
bodies: ( { mesh = "cube.stl"; #bodies
 } );
initial: { U = 3.0; };
shapes: ( { form = "mesh"; mesh = "water.stl"; #shapes
 } );
sph: { dx = 0.2; R_dx = 2.5; c0 = 30.0; packing = 3; };' ;;
    regions) echo 'fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.0625; R_dx = 2.5; };
apr: { regions = ( { level = 2; min = (-0.4, -0.3); max = (0.4, 0.3); #regions
 } ); };' ;;
    swirls) echo 'fluid: { rho = 1.0; nu = 0.01; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, true); };
initial: { field = "taylor_green"; U = 1.0; L = 2.0; };
sph: { dx = 0.05; R_dx = 2.5; };
apr: { around = 2; criteria = ( { kind = "vorticity"; above = 0.24; #criteria
 } ); };' ;;
    wave) echo 'fluid: { rho = 1.0; nu = 0.002; gravity = (0, -1); };
domain: { dim = 2; min = (-1, -1); max = (1, 1); periodic = (true, false); };
walls: ( { side = "y_min"; kind = "no_slip"; #walls
 } );
initial: { field = "standing_wave"; U = 0.1; L = 2.0; amplitude = 0.05; level = 0.0; };
sph: { dx = 0.1; c0 = 10.0; };' ;;
    train | group) echo 'fluid: { rho = 1000.0; gravity = (0, -9.81); };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { U = 3.0; };
walls: ( { side = "x_min"; kind = "wave"; #walls
 }, { side = "x_max"; kind = "beach"; beach = 0.5; beach_period = 0.6; }, { side = "y_min"; } );
shapes: ( { form = "below"; level = 0.0; #shapes
 } );
sph: { dx = 0.1; c0 = 30.0; };
waves: { height = 0.05; length = 0.7; start = 0.05;' "$([ "$1" = train ] || echo 'kind = "focused";') };" ;;
    drop) echo 'fluid: { rho = 1.0; central = 1.0; };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { field = "drop"; L = 0.5; };
sph: { dx = 0.1; };' ;;
    lines) echo 'fluid: { rho = 1000.0; nu = 0.01; gravity = (0, -9.81); };
domain: { dim = 2; min = (-1, -1); max = (1, 1); };
initial: { U = 3.0; };
walls: ( { points = ((-1, 1), (-1, -1), (0.5, -1), (1, -0.5), (1, 1)); kind = "no_slip"; #walls
 } );
shapes: ( { form = "below"; level = 0.8; #shapes
 } );
sph: { dx = 0.1; c0 = 30.0; scheme = "delta"; };' ;;
    esac
    [ "$1" = swirls ] && echo "$head" | sed 's/0.04/0.02/' || echo "$head"
}

# What a run leaves behind, without times and names.
trace() {
    (cd "$1" 2>/dev/null && echo * && exec sed '/"time_s"/,/}/d; /_s":/d; /"modules"/d; /"version"/d; /"case"/d' series.csv summary.json)
}
try() { # MODE KEY VALUE
    key=$2 value=$3
    case $mode:$key in
    float:bodies.free | hinge:bodies.free | touch:bodies.free) value=false ;;
    float:bodies.contact | hinge:bodies.contact) return ;; # they touch nothing
    float:sph.surface | hinge:sph.surface | mesh:sph.surface | dam:sph.surface | cube:sph.surface | wave:sph.surface | train:sph.surface | group:sph.surface | drop:sph.surface | lines:sph.surface) value=no ;;
    cube:sph.walls) value=nfm ;;
    dam:domain.max) value='(0.3,1.2)' ;; # the water is far from the wall
    float:sph.viscosity | hinge:sph.viscosity | mesh:sph.viscosity | wave:sph.viscosity | lines:sph.viscosity) value=morris ;; # monaghan is what auto takes there
    swirls:sph.dx) value=0.04 ;;
    delta:sph.surface) return ;; # looked for, and not found in a full box
    wave:walls.kind | lines:walls.kind) value='"slip"' ;;
    cube:domain.dim) value=2 ;;
    wave:domain.periodic) value='(false,false)' ;;
    box:sph.outer) return ;; # the word for what a box takes by itself
    box:domain.*) return ;; # what a box in an exact solution must lie in, no more
    touch:bodies.contact.friction) return ;; # a slider does not slip
    mesh:domain.dim) value=2 ;;
    mesh:sph.packing) value=0 ;;
    mesh:bodies.thin) return ;; # it is thicker than what particles see
    body:sph.background) return ;; # lifts negative pressures: there are none in a tank at rest
    esac
    case=base.cfg
    case $key in
    walls.* | bodies.* | shapes.* | probes.* | apr.regions.* | apr.criteria.*)
        group=${key%.*} name=${key##*.}
        group=${group##*.}
        case $scene in *"#$group"*) ;; *) return ;; esac
        case $value in [a-z]_[a-z]* | no_slip) value="\"$value\"" ;; esac
        sed "/#$group/{s/\\([{;] *\\)$name = [^;]*;/\\1/; s/#$group/ $name = $value; #/;}" base.cfg >case.cfg
        case=case.cfg
        set -- ;;
    *) set -- -p "$key=$value" ;;
    esac
    rm -rf out
    timeout 60 "$b/sph" $case -o out "$@" >out.txt 2>&1 </dev/null
    code=$?
    if [ $code = 2 ] && grep -q 'syntax error' out.txt; then
        echo "FAIL: $mode: $key = $value: the test's own case is no case" && failed=$((failed + 1))
    elif [ $code = 2 ]; then
        refused=$((refused + 1))
    elif [ "$(trace out)" = "$trace" ]; then
        echo "FAIL: $mode: $key = $value is accepted and changes nothing" && failed=$((failed + 1))
    else
        passed=$((passed + 1))
    fi
}

known=$(echo "$values" | awk 'NF { print $1 }')
for key in $("$b/sph" --params | sed -n 's/^| `\([a-z_A-Z0-9]*\.[a-zA-Z_0-9.]*\)` .*/\1/p'); do
    case " $exceptions " in *" $key "*) continue ;; esac
    case $key in accept.*) continue ;; esac
    echo "$known" | grep -qx "$key" || { echo "FAIL: no other value is known for $key: add it here"; failed=$((failed + 1)); }
done
# float has all else of hinge and touch, dam all else of train but waves and walls, train all else of group, so that by
# default the keys of the groups that differ will do
ours() { case $every:$1 in :hinge | :touch) echo bodies ;; :train) echo wa ;; :group) echo waves ;; esac; }
every=
[ "${1:-}" = all ] && every=yes && set -- vortices delta dam body float hinge touch box channel cube mesh wave train group drop lines regions swirls
[ $# -gt 0 ] || set -- dam channel float hinge touch mesh train group swirls
for solid in "tank -0.8 0.8 zp" "cube -0.3 0.1" "other -0.5 0.3" "water -1 0.5"; do # NAME LOW HIGH [open face]
    echo "$solid" | while read -r name low high open; do
        stl "$low $low $low" "$high $high $high" "$open" >"$name.stl"
    done
done
printf "0,0\n0.3,0\n0,0.4\n0,0\n" >other.csv
for mode; do
    scene "$mode" >base.cfg
    rm -rf base
    timeout 60 "$b/sph" base.cfg -o base >out.txt 2>&1 </dev/null || { echo "FAIL: $mode does not run"; cat out.txt; failed=$((failed + 1)); }
    trace=$(trace base) scene=$(cat base.cfg) ours=$(ours "$mode")
    while read -r key value; do
        case $key in ${ours:-?}*) try "$mode" "$key" "$value" ;; esac
    done <<END
$values
END
done
echo "unused: $refused refused, $passed change the run, $failed neither"
[ $failed = 0 ]
