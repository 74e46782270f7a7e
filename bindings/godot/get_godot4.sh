# Puts Godot 4 of Debian sid with all that it needs into a folder, of which FOLDER/godot4 runs it: sh get_godot4.sh FOLDER.
# Nothing is installed, and no root is needed. For Debian and its relatives, on x86-64.
set -e
folder=$1
if [ -x "$folder/godot4" ]; then
    exit 0
fi
if ! command -v apt-get > /dev/null || [ "$(dpkg --print-architecture)" != amd64 ]; then
    echo "deps-godot4: no apt-get, or not amd64: get Godot 4.2 or later, and say GODOT4=path"
    exit 1
fi
mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial" "$folder/root"
folder=$(cd "$folder" && pwd)
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian sid main" > "$folder/sources.list"
cat > "$folder/apt.conf" << END
Dir::Etc::sourcelist "$folder/sources.list";
Dir::Etc::sourceparts "-";
Dir::State::lists "$folder/lists";
Dir::Cache "$folder/cache";
Dir::State::status "/dev/null";
Debug::NoLocking "1";
APT::Sandbox::User "";
END
export APT_CONFIG="$folder/apt.conf"
apt-get -qq update
apt-get -qq install --download-only --no-install-recommends -y godot libgl1 libgl1-mesa-dri libglx-mesa0 > "$folder/log"
for package in "$folder"/cache/archives/*.deb; do
    dpkg-deb -x "$package" "$folder/root"
done
rm -r "$folder/cache" "$folder/lists"
# With its own C library, whatever is here.
libraries=$folder/root/usr/lib/x86_64-linux-gnu
cat > "$folder/godot4" << END
#!/bin/sh
export LIBGL_DRIVERS_PATH=$libraries/dri
exec $libraries/ld-linux-x86-64.so.2 --library-path $libraries:$libraries/pulseaudio $folder/root/usr/bin/godot "\$@"
END
chmod +x "$folder/godot4"
"$folder/godot4" --version
