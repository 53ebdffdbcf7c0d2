# Sourced by scripts/robot and scripts/fuseki. need_java_tool NAME ARTIFACT sets $java and $jars, the
# folder with the jars of NAME-pom.xml, fetched from Maven Central once into $XDG_CACHE_HOME/symboslam.
# Exit code 3: it cannot be had here (no Java, no Maven, no network).
here=$(cd "$(dirname "$0")" && pwd)

cannot() { echo "scripts/$script: $1" >&2; exit 3; }

need_java_tool() {
  local name=$1 artifact=$2 pom version cache part
  script=$(printf '%s' "$name" | sed 'y/ABCDEFGHIJKLMNOPQRSTUVWXYZ/abcdefghijklmnopqrstuvwxyz/')
  pom=$here/$script-pom.xml
  version=$(grep -A1 "$artifact" "$pom" | sed -n 's:.*<version>\(.*\)</version>.*:\1:p')
  cache=${XDG_CACHE_HOME:-$HOME/.cache}/symboslam
  jars=$cache/$script-$version

  java=${JAVA_HOME:+$JAVA_HOME/bin/java}
  if [ ! -x "${java:-}" ]; then java=$(command -v java) || cannot \
    "no Java, so $name cannot be run: install one (Debian: apt-get install default-jre-headless)"; fi

  if [ -d "$jars" ]; then return; fi
  command -v mvn >/dev/null || cannot \
    "no Maven, so $name cannot be fetched: install it (Debian: apt-get install maven)"
  echo "Fetching $name $version from Maven Central into $jars ..." >&2
  mkdir -p "$cache" || cannot "$cache cannot be made"
  part=$(mktemp -d "$cache/.$script-XXXXXX")
  # shellcheck disable=SC2064 # its value now
  trap "rm -rf '$part'" EXIT
  mvn -q -B --strict-checksums -f "$pom" dependency:copy-dependencies \
    -DincludeScope=runtime -DoutputDirectory="$part/jars" >&2 || cannot \
    "Maven could not fetch $name $version (see above)"
  # Whole or not at all; where another process was faster, its jars stay.
  [ -d "$jars" ] || mv "$part/jars" "$jars"
  rm -rf "$part"
  trap - EXIT
}
