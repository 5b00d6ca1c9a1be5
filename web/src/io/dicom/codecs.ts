/** Decoders for compressed frames. Each is loaded when the first frame needs it. */
import type { Bytes } from '../source';
import type { Decoded } from './decoded';
import { decodeLossless } from './jpeg-lossless';

/** Decodes a frame; throws if it is damaged. */
export type Decode = (frame: Bytes) => Decoded;

interface Decoder {
  getEncodedBuffer(length: number): Uint8Array;
  getDecodedBuffer(): Uint8Array;
  getFrameInfo(): { width: number; height: number; bitsPerSample: number; componentCount: number };
  decode(): void;
  delete(): void;
}

const SILENT = { print: () => {}, printErr: () => {} };

type Glue = (options: { wasmBinary: ArrayBuffer } & typeof SILENT) => Promise<Record<string, unknown>>;

interface Package {
  readonly glue: () => Promise<{ default: unknown }>;
  readonly wasm: () => Promise<{ default: string }>;
  readonly decoder: string;
}

const PACKAGES = {
  jpeg: {
    glue: () => import('@cornerstonejs/codec-libjpeg-turbo-8bit/decodewasmjs'),
    wasm: () => import('@cornerstonejs/codec-libjpeg-turbo-8bit/decodewasm?url'),
    decoder: 'JPEGDecoder',
  },
  jpegLs: {
    glue: () => import('@cornerstonejs/codec-charls/decodewasmjs'),
    wasm: () => import('@cornerstonejs/codec-charls/decodewasm?url'),
    decoder: 'JpegLSDecoder',
  },
  jpeg2000: {
    glue: () => import('@cornerstonejs/codec-openjpeg/decodewasmjs'),
    wasm: () => import('@cornerstonejs/codec-openjpeg/decodewasm?url'),
    decoder: 'J2KDecoder',
  },
  highThroughput: {
    glue: () => import('@cornerstonejs/codec-openjph/wasmjs'),
    wasm: () => import('@cornerstonejs/codec-openjph/wasm?url'),
    decoder: 'HTJ2KDecoder',
  },
} as const satisfies Readonly<Record<string, Package>>;

export type CodecName = keyof typeof PACKAGES | 'jpegLossless';

export const CODECS: Readonly<Record<string, CodecName>> = {
  '1.2.840.10008.1.2.4.50': 'jpeg',
  '1.2.840.10008.1.2.4.51': 'jpeg',
  '1.2.840.10008.1.2.4.57': 'jpegLossless',
  '1.2.840.10008.1.2.4.70': 'jpegLossless',
  '1.2.840.10008.1.2.4.80': 'jpegLs',
  '1.2.840.10008.1.2.4.81': 'jpegLs',
  '1.2.840.10008.1.2.4.90': 'jpeg2000',
  '1.2.840.10008.1.2.4.91': 'jpeg2000',
  '1.2.840.10008.1.2.4.201': 'highThroughput',
  '1.2.840.10008.1.2.4.202': 'highThroughput',
  '1.2.840.10008.1.2.4.203': 'highThroughput',
};

const loaded = new Map<CodecName, Promise<Decode>>();

export function decoderOf(name: CodecName): Promise<Decode> {
  const known =
    loaded.get(name) ??
    (name === 'jpegLossless' ? Promise.resolve(decodeLossless) : ofPackage(PACKAGES[name]));
  loaded.set(name, known);
  return known;
}

/** Drops a decoder after a failure, which may have corrupted its state. The next frame loads it again. */
export function forgetDecoder(name: CodecName): void {
  loaded.delete(name);
}

async function ofPackage({ glue, wasm, decoder }: Package): Promise<Decode> {
  const [made, address] = await Promise.all([glue(), wasm()]);
  const wasmBinary = await (await fetch(address.default)).arrayBuffer();
  const codec = await (made.default as Glue)({ wasmBinary, ...SILENT });
  const Constructor = codec[decoder] as new () => Decoder;
  return (frame) => decodedBy(new Constructor(), frame);
}

function decodedBy(decoder: Decoder, frame: Bytes): Decoded {
  try {
    decoder.getEncodedBuffer(frame.length).set(frame);
    decoder.decode();
    const { width, height, bitsPerSample, componentCount } = decoder.getFrameInfo();
    // Copied, because the decoder reuses its memory for the next frame.
    const bytes = decoder.getDecodedBuffer().slice();
    return {
      columns: width,
      rows: height,
      components: componentCount,
      bytes,
      unit: bitsPerSample > 8 ? 2 : 1,
    };
  } finally {
    decoder.delete();
  }
}
