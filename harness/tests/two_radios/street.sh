# A crossing of ARI and Go2, each in a network namespace of its own with an on-board unit of its own; air.py joins the
# units. Arguments: try, or the folder with the robots' files and what happens while the corridor is open: whole,
# kill-body or kill-unit (of Go2). PROGRAM is crossguard, UNIT the command of a unit, TESTS the folder of air.py.
set -e
radio() {
    unshare --net sleep 300 &
    eval "$1=$!"
    until [ "$(readlink /proc/$!/ns/net)" != "$(readlink /proc/$$/ns/net)" ]; do sleep 0.01; done
    ip link add "air-$1" type veth peer name "radio"
    ip link set radio netns $!
    ip link set "air-$1" up
    nsenter --target $! --net ip link set lo up
    nsenter --target $! --net ip link set radio up
}
radio ari
radio go2
# shellcheck disable=SC2154 # radio sets both
trap 'kill $ari $go2' EXIT
[ "$1" = try ] && exit 0
in_ari() { nsenter --target "$ari" --net "$@"; }
in_go2() { nsenter --target "$go2" --net "$@"; }
cd "$1"
python3 "$TESTS/two_radios/air.py" air-ari air-go2 0.05 10 15 air.txt &
air=$!
export CROSSGUARD_EXAMPLE_UNIT="127.0.0.1:4747 ethernet radio 0.8"
# shellcheck disable=SC2086 # words are meant to be split
in_ari $UNIT > /dev/null &
# Not by the function, whose shell would be what is killed.
# shellcheck disable=SC2086 # words are meant to be split
nsenter --target "$go2" --net $UNIT > /dev/null &
unit=$!
# Go2 quits when ARI has.
mkfifo typed
in_go2 "$PROGRAM" run --config Go2.toml --security enforce --pki pki/robots/Go2 --json < typed > Go2.log &
follower=$!
exec 3> typed
printf 'wait 3\ndetect\nuntil maneuver-executing 60\nuntil idle 120\nwait 4\nquit\n' |
    in_ari "$PROGRAM" run --config ARI.toml --security enforce --pki pki/robots/ARI --json > ARI.log &
leader=$!
until [ -S ARI.sock ] && [ -S Go2.sock ]; do sleep 0.05; done
python3 "$TESTS/../examples/body.py" unix:ARI.sock 0 -1.5 "$PACE" 2> /dev/null &
python3 "$TESTS/../examples/body.py" unix:Go2.sock 1 -1.11 "$PACE" 2> /dev/null &
body=$!
if [ "$2" != whole ]; then
    until grep -q '"corridorOpened"' ARI.log; do
        kill -0 $leader || exit 90
        sleep 0.05
    done
    sleep 0.5
    case $2 in
        kill-body) kill -9 $body ;;
        kill-unit) kill -9 $unit ;;
    esac
fi
wait $leader
echo quit >&3
exec 3>&-
wait $follower
kill $air
wait $air
