/** A disk's numbers, one entry per disk; lengths, times and masses in the units of the scene. */
export interface CaromState {
  time: number;
  /** Collisions of pairs so far. */
  pairs: number;
  x: Float64Array;
  y: Float64Array;
  vx: Float64Array;
  vy: Float64Array;
  radius: Float64Array;
  mass: Float64Array;
}

/** What a script can do with a page of the playground: window.carom there. */
export interface Carom {
  readonly ready: Promise<void>;
  /** Loads a scene from TOML text. Rejects with a sentence where it is wrong; the scene before then goes on. */
  load(toml: string, options?: { overrides?: string[]; changes?: string }): Promise<object>;
  /** Loads one of the scenes of the page. */
  scene(id: string, start?: Record<string, number>): Promise<object>;
  scenes(): string[];
  /** Runs to a time; resolves with it. Rejects where the run cannot go on. */
  runUntil(time: number): Promise<number>;
  /** Sets a key of the scene now, such as set("gravity.acceleration", [0, -1]). */
  set(key: string, value: unknown): Promise<object>;
  /** Makes a change now, written as in a list of changes: change("remove_disk = 3"). */
  change(body: string): Promise<object>;
  /** Resolves with the 16 digits that carom run gives for the same run at this time. */
  stateHash(): Promise<string>;
  state(): Promise<CaromState>;
  /** Resolves with the list of changes so far, for carom run --changes. */
  changes(): Promise<string>;
  /** Resolves with an address that holds the scene and all changes. */
  link(): Promise<string>;
  play(isPlaying?: boolean): void;
}

export declare class CaromBox extends HTMLElement {
  readonly ready: Promise<Carom>;
}

declare global {
  interface HTMLElementTagNameMap {
    "carom-box": CaromBox;
  }
}
