#!/bin/sh
# A job over two hosts: two network namespaces of this machine, joined by a cable, with host names of their own, so that no
# process sees those of the other host. The same bits as on one host, a window's latency, a killed program, a killed host
# and a cut cable, each named. Skipped where namespaces are not allowed. SPDX-License-Identifier: BSD-3-Clause
. "$(dirname "$0")/lib.sh"
[ "$(id -u)" = 0 ] || { echo "skipped: two hosts want root (namespaces of the network)"; exit 0; }
command -v ip >/dev/null || { echo "skipped: two hosts want the program ip (apt-get install iproute2)"; exit 0; }
east=estran$$e west=estran$$w
clean() {
    for ns in $east $west; do
        for p in $(ip netns pids $ns 2>/dev/null); do kill -KILL "$p" 2>/dev/null; done
        ip netns delete $ns 2>/dev/null
    done
}
trap clean EXIT
trap 'exit 1' INT TERM
{ ip netns add $east && ip netns add $west && ip link add name e netns $east type veth peer name w netns $west &&
    ip -n $east addr add 10.97.1.1/24 dev e && ip -n $west addr add 10.97.1.2/24 dev w && unshare --uts true; } 2>err ||
    { echo "skipped: no namespaces here: $(head -n 1 err)"; exit 0; }
for ns in $east $west; do ip -n $ns link set lo up; done
ip -n $east link set e up
ip -n $west link set w up

export ASAN_OPTIONS=detect_leaks=0:handle_segv=0
unset OMPI_MCA_pml OMPI_MCA_ess_singleton_isolated # hosts are reached as users reach them
E=10.97.1.1:8 W=10.97.1.2:8
# what mpirun takes for ssh: enters the other host
cat >agent <<AGENT
#!/bin/sh
shift
exec ip netns exec $west unshare --uts sh -c "hostname west; \$*"
AGENT
chmod 755 agent
# the options of cases/run --hosts
hosts="--mca plm_rsh_agent $tmp/agent --mca plm_rsh_no_tree_spawn 1 --mca btl_tcp_if_include 10.97.1.0/24 --mca oob_tcp_if_include 10.97.1.0/24
    --mca oob_tcp_keepalive_time 2 --mca oob_tcp_keepalive_intvl 1 --mca oob_tcp_keepalive_probes 2"
options="--quiet --bind-to none --mca mpi_yield_when_idle 1 --mca btl_vader_single_copy_mechanism none"
bad() {
    echo "FAIL: $*"
    sed 's/^/      | /' text 2>/dev/null | tail -n 12
    failed=$((failed + 1))
}
cat >case.cfg <<'CASE'
format = 1;
time:   { end = 0.5; };
coupler: { programs = "sph fv"; period = (1.0, 1.0); };
CASE
np=2 # ranks of each program
# job "HOSTS OF SPH" "OF COUPLER" "OF FV" KEYS...: into the folder o; sets code and ms; "-" for all on one host
job() {
    rm -rf o
    h1=$1 h2=$2 h3=$3
    shift 3
    keys=$*
    line="-np $np $h1 $b/tests/mock sph points o $* : -np $np $h2 $b/coupler case.cfg -o o : -np $np $h3 $b/tests/mock fv grid o ${keys%%fault*}"

    if [ -z "$h1" ]; then
        # shellcheck disable=SC2086
        timeout -k 1 60 mpirun $options --oversubscribe $line >text 2>&1
    else
        # shellcheck disable=SC2086
        timeout -k 1 60 ip netns exec $east unshare --uts sh -c "hostname east; exec mpirun $(echo $options $hosts) $line" >text 2>&1
    fi
    code=$?
}
once() { # COMMAND...: waits until it is true, 20 s at most
    tries=0
    until "$@" 2>/dev/null || [ $tries = 400 ]; do
        sleep 0.05
        tries=$((tries + 1))
    done
}
got() { cat o/"$1".* | sort -n -k1,1 -k2,2 | cksum; }

job "" "" "" n=24
[ $code = 0 ] || bad "on one host: exit $code"
sph=$(got sph) fv=$(got fv)
both="-H $E,$W --map-by node"
for where in split both; do
    [ $where = split ] && job "-H $E" "-H $E" "-H $W" n=24 || job "$both" "$both" "$both" n=24
    [ $code = 0 ] || bad "on two hosts ($where): exit $code"
    [ "$(got sph) $(got fv)" = "$sph $fv" ] || bad "on two hosts ($where): other bits than on one"
done

# 2000 windows of four hops over the cable
np=1
job "-H $E" "-H $E" "-H $W" n=8 dt=0.00025
us=$(awk -F'[:,]' '/"wall_s"/ { w = $2 } /"windows"/ { n = $2 } END { if (n == 2000) printf "%.0f", 1e6 * w / n }' o/summary.json)
echo "a window between two hosts: ${us:-?} us"
np=2
[ "${us:-99999}" -le 50000 ] || bad "a window between two hosts takes ${us:-?} us, wanted at most 50 000 (1 000 on a quiet machine)"

# sph and fv by cases/run --hosts: the same to the last digit, and its exit codes
real() { # DIR ARGS...: a small coupled job; fv alone on the other host
    dir=$1
    shift
    ip netns exec $east unshare --uts env ESTRAN_BUILD="$b" OMPI_MCA_plm_rsh_agent="$tmp/agent" OMPI_MCA_plm_rsh_no_tree_spawn=1 \
        OMPI_MCA_btl_tcp_if_include=10.97.1.0/24 OMPI_MCA_oob_tcp_if_include=10.97.1.0/24 \
        sh -c 'hostname east; exec timeout -k 1 60 "$@"' sh "$root/cases/run" taylor_green -o "$dir" --force -p sph.dx=0.02 -p "fv.cells=(24,24)" \
        -p output.snapshots=false "$@" >text 2>&1
    code=$?
}
error() { sed -n 's/.*"velocity_l2": *\([-+0-9.e]*\).*/\1/p' "$1/summary.json" | head -n 1; }
real r1 -n 1:1:1 -p time.end=0.12 -p output.every=0
real r2 -n 1:1:1 -p time.end=0.12 -p output.every=0 --hosts 10.97.1.1:2,10.97.1.2:1
[ $code = 0 ] || bad "sph and fv on two hosts: exit $code"
[ -n "$(error r1)" ] && [ "$(error r1)" = "$(error r2)" ] || bad "sph and fv on two hosts: error $(error r2), on one $(error r1)"
cut() {
    once grep -q ' %  left' text
    ip -n $east link set e down
}
: >text
cut &
real r3 -n 1:1:1 -p time.end=9 --hosts 10.97.1.1:2,10.97.1.2:1
wait
[ $code = 4 ] || bad "sph and fv, the cable cut: exit $code, wanted 4"
for p in sph coupler; do
    grep "^$p rank 0: " text | grep -q 'fv on west' || bad "sph and fv, the cable cut: $p does not name it"
done
grep -q '^cases/run: a host of the job, or the link to it, was lost' text || bad "sph and fv, the cable cut: cases/run does not say it"
for p in $(ip netns pids $west); do kill -KILL "$p" 2>/dev/null; done
ip -n $east link set e up

# waits until window 2 is done, then lets it happen; the job sleeps for 3 s in window 3 or waits
happens() {
    rm -rf o
    once grep -q '^2 ' o/sph.0
    date +%s%3N >when
    "$@"
}
ended() { # "of what": long before the job's 60 s are over; 2 to 6 s on a quiet machine
    since=$(($(date +%s%3N) - $(cat when)))
    [ $since -le 30000 ] || bad "$1: the job ended after $since ms, wanted at most 30 000"
    echo "$1: exit $code after $since ms"
    [ $code != 0 ] || bad "$1: exit code 0"
}
named() { # PROGRAM "what" "of what": both ranks of PROGRAM say it
    n=$(grep "^$1 rank [01]: " text | grep -c "$2")
    [ "$n" -ge 1 ] || bad "$3: $1 does not say \"$2\": $(grep "^$1 rank" text | head -n 2)"
}
slow="fault=sleep at=3"

# a program killed on the other host: its own neighbour there leaves the note
fv_process() { ip netns pids $west | while read -r p; do [ "$(readlink /proc/$p/exe)" = "$(readlink -f "$b/tests/mock")" ] && echo $p; done | head -n 1; }
kill_fv() { kill -KILL "$(fv_process)"; }
happens kill_fv &
sleep 0.1
job "-H $E" "-H $E" "-H $W" n=40 $slow
wait
ended "fv killed on the other host"
named sph 'fv' "fv killed on the other host"
named coupler 'fv' "fv killed on the other host"

# all processes of the other host killed, its launcher's too
kill_west() { for p in $(ip netns pids $west); do kill -KILL "$p" 2>/dev/null; done; }
happens kill_west &
sleep 0.1
job "-H $E" "-H $E" "-H $W" n=40 $slow
wait
ended "a host killed"
named sph 'fv on west' "a host killed"
named coupler 'fv on west' "a host killed"

# The cable cut while the line is quiet: what is sent and not yet acknowledged would keep the link alive for
# net.ipv4.tcp_retries2 trials of the kernel (coupler/README.md)
cut_quietly() {
    sleep 0.5
    date +%s%3N >when
    ip -n $east link set e down
}
happens cut_quietly &
sleep 0.1
job "-H $E" "-H $E" "-H $W" n=40 $slow
wait
ended "the cable cut"
named sph 'fv on west' "the cable cut"
named coupler 'fv on west' "the cable cut"
kill_west
ip -n $east link set e up
[ $failed = 0 ]
