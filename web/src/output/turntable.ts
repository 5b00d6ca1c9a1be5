/** A full turn about the patient's long axis as a film (WebM), picture by picture at full resolution. */
import { turnedAbout } from '../core/camera';
import { Failure } from '../core/failure';
import type { Camera } from '../core/messages';
import * as store from '../state/store';
import { composed, saveAs } from './pictures';

const FRAMES = 72;
const PER_SECOND = 18;

/** Renders a turn of the view and saves it; the view is as it was then. Escape ends it early and saves nothing. */
export async function saveTurntable(): Promise<void> {
  const camera = store.camera.value;
  if (!camera || store.progress.value) {
    return;
  }
  const film = new Film();
  try {
    for (let n = 0; n < FRAMES; n++) {
      store.progress.value = { words: 'Turntable', done: n, total: FRAMES };
      await film.add(turnedAbout(camera, camera.center, [0, 0, 1], (2 * Math.PI * n) / FRAMES));
      if (store.progress.value === null) {
        return;
      }
    }
    saveAs(await film.finish(), 'lumencut.webm');
  } catch (error) {
    store.problem.value = Failure.of(error);
  } finally {
    film.close();
    store.progress.value = null;
    store.camera.value = camera;
  }
}

/** Records what a canvas shows, one frame for each picture that is added. */
class Film {
  private readonly canvas = document.createElement('canvas');
  private recorder: MediaRecorder | null = null;
  private readonly parts: Blob[] = [];
  private track: CanvasCaptureMediaStreamTrack | null = null;

  async add(camera: Camera): Promise<void> {
    store.camera.value = camera;
    await settled(camera);
    const picture = composed('labels');
    const isFirst = this.recorder === null;
    if (isFirst) {
      [this.canvas.width, this.canvas.height] = [picture.width, picture.height];
    }
    this.canvas.getContext('2d')?.drawImage(picture, 0, 0, this.canvas.width, this.canvas.height);
    if (isFirst) {
      this.begin();
    }
    this.track?.requestFrame();
    await new Promise((resolve) => setTimeout(resolve, 1000 / PER_SECOND));
  }

  private begin(): void {
    const stream = this.canvas.captureStream(0);
    this.track = stream.getVideoTracks()[0] as CanvasCaptureMediaStreamTrack;
    this.recorder = new MediaRecorder(stream, { mimeType: 'video/webm', videoBitsPerSecond: 12e6 });
    this.recorder.ondataavailable = (event) => this.parts.push(event.data);
    this.recorder.start();
  }

  async finish(): Promise<Blob> {
    const recorder = this.recorder;
    if (!recorder) {
      throw new Failure('picture', 'turntable', 'no pictures', 'a scan that is open');
    }
    const stopped = new Promise((resolve) => {
      recorder.onstop = resolve;
    });
    recorder.stop();
    await stopped;
    return new Blob(this.parts, { type: 'video/webm' });
  }

  close(): void {
    this.track?.stop();
  }
}

/** Waits until the view shows this camera with all its pixels. */
function settled(camera: Camera): Promise<void> {
  return new Promise((resolve) => {
    const stop = store.settled.subscribe((shown) => {
      if (shown === camera) {
        queueMicrotask(() => stop());
        resolve();
      }
    });
  });
}
