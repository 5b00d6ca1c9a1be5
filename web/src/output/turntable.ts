/** Saves a full turn about the patient's long axis, as a WebM film or as PNGs in a zip archive. */
import { turnedAbout } from '../core/camera';
import { Failure } from '../core/failure';
import { DEFAULTS } from '../core/generated/tables';
import type { Camera } from '../core/messages';
import * as store from '../state/store';
import { studyFileName } from './file-names';
import { composed, saveAs } from './pictures';

const FRAMES = DEFAULTS['turntable.frames'];
const PER_SECOND = 18;

interface Album {
  add(picture: HTMLCanvasElement): Promise<void>;
  finish(): Promise<Blob>;
  close?(): void;
}

export const saveFilm = (): Promise<void> => saveTurn(new Film(), 'webm');

export const savePictures = async (): Promise<void> => {
  const { PictureArchive } = await import('./picture-archive');
  return saveTurn(new PictureArchive(), 'zip');
};

/** Renders all views of the turn, saves them, and restores the view. Escape cancels without saving. */
async function saveTurn(album: Album, ending: string): Promise<void> {
  const camera = store.camera.value;
  if (!camera || store.progress.value) {
    return;
  }
  try {
    for (let n = 0; n < FRAMES; n++) {
      store.showProgress({ words: 'Turntable', done: n, total: FRAMES });
      const turned = turnedAbout(camera, camera.center, [0, 0, 1], (2 * Math.PI * n) / FRAMES);
      store.setCamera(turned);
      await untilComplete(turned);
      await album.add(await composed('labels'));
      if (store.progress.value === null) {
        return;
      }
    }
    const film = await album.finish();
    saveAs(film, studyFileName({ content: 'turntable', ending }));
  } catch (error) {
    store.showProblem(error);
  } finally {
    album.close?.();
    store.showProgress(null);
    store.setCamera(camera);
  }
}

/** Records a film from a canvas, with one frame per picture. */
class Film implements Album {
  private readonly canvas = document.createElement('canvas');
  private recorder: MediaRecorder | null = null;
  private readonly parts: Blob[] = [];
  private track: CanvasCaptureMediaStreamTrack | null = null;

  async add(picture: HTMLCanvasElement): Promise<void> {
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
      throw new Failure('picture', 'turntable', 'no pictures', 'an open scan');
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

function untilComplete(camera: Camera): Promise<void> {
  return new Promise((resolve) => {
    const stop = store.completeCamera.subscribe((shown) => {
      if (shown === camera) {
        queueMicrotask(() => stop());
        resolve();
      }
    });
  });
}
