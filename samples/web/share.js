// A run as a link: the recording of all calls, packed, behind the # of the address. Nothing is sent to a server.

async function through(stream, bytes) {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

export async function pack(bytes) {
    const packed = await through(new CompressionStream("gzip"), bytes);
    let text = "";
    for (let i = 0; i < packed.length; i += 8192) {
        text += String.fromCharCode(...packed.subarray(i, i + 8192));
    }
    return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

export async function unpack(text) {
    const plain = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    return through(new DecompressionStream("gzip"), Uint8Array.from(plain, (c) => c.charCodeAt(0)));
}

/** Keeps what a world records. */
export class Tape {
    parts = [];
    length = 0;

    take = (bytes) => {
        this.parts.push(bytes);
        this.length += bytes.length;
    };

    /** Forgets what came after so many bytes: the world is as it was then. */
    rewind(length) {
        this.parts = [this.bytes().slice(0, length)];
        this.length = length;
    }

    bytes() {
        const all = new Uint8Array(this.parts.reduce((sum, part) => sum + part.length, 0));
        let at = 0;
        for (const part of this.parts) {
            all.set(part, at);
            at += part.length;
        }
        this.parts = [all];
        return all;
    }
}
