# Read by run and nightly: each stage says its name before it begins and its time after it.
stage() {
    name=$1
    shift
    echo "== $name: $*"
    began=$(date +%s)
    "$@"
    echo "== $name: $(($(date +%s) - began)) s"
}
