// The sound of cutting, made from the speed of the blade and what it cuts: filtered noise.

export class Sound {
    constructor() {
        this.look = { pitch: 3000, width: 1, volume: 0.5 };
        this.muted = false;
    }

    /** Browsers let pages sound after the first touch. */
    wake() {
        if (this.context || !globalThis.AudioContext) {
            return;
        }
        const context = this.context = new AudioContext();
        const buffer = context.createBuffer(1, 2 * context.sampleRate, context.sampleRate), data = buffer.getChannelData(0);
        for (let i = 0; i < data.length; i++) {
            data[i] = Math.random() * 2 - 1;
        }
        this.noise = buffer;
        const source = new AudioBufferSourceNode(context, { buffer, loop: true });
        this.filter = new BiquadFilterNode(context, { type: "bandpass" });
        this.gain = new GainNode(context, { gain: 0 });
        source.connect(this.filter).connect(this.gain).connect(context.destination);
        source.start();
    }

    /** speed: pixels of this frame. */
    cut(speed) {
        if (!this.context) {
            return;
        }
        const now = this.context.currentTime, { pitch, width, volume } = this.look, loud = 1 - Math.exp(-speed / 18);
        this.filter.Q.value = width;
        this.filter.frequency.setTargetAtTime(pitch * (0.7 + 0.5 * loud), now, 0.03);
        this.gain.gain.setTargetAtTime(this.muted ? 0 : 0.5 * volume * loud, now, speed ? 0.015 : 0.05);
    }

    snip() {
        if (!this.context || this.muted) {
            return;
        }
        const now = this.context.currentTime;
        const source = new AudioBufferSourceNode(this.context, { buffer: this.noise });
        const filter = new BiquadFilterNode(this.context, { type: "bandpass", frequency: 1.3 * this.look.pitch, Q: 1.5 });
        const gain = new GainNode(this.context, { gain: 0.4 * this.look.volume });
        gain.gain.setTargetAtTime(0, now, 0.018);
        source.connect(filter).connect(gain).connect(this.context.destination);
        source.start(now, Math.random());
        source.stop(now + 0.12);
    }

    /** Two soft notes, higher with each step. */
    chime(step) {
        if (!this.context || this.muted) {
            return;
        }
        [1, 1.5].forEach((ratio, i) => {
            const at = this.context.currentTime + 0.12 * i, gain = new GainNode(this.context, { gain: 0 });
            const tone = new OscillatorNode(this.context, { type: "sine", frequency: 392 * 1.125 ** step * ratio });
            gain.gain.setTargetAtTime(0.12, at, 0.01);
            gain.gain.setTargetAtTime(0, at + 0.08, 0.25);
            tone.connect(gain).connect(this.context.destination);
            tone.start(at);
            tone.stop(at + 1.6);
        });
    }
}
