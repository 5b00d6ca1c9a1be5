/** Converts headers to plain records for the crate `lumencut-dicom`. */
import type { Element } from 'dicom-parser';
import { attribute, TAGS } from './attributes';
import type { Parsed } from './parsing';
import { decoderOf, textsOf, type Value, valueIn } from './values';

export type Attributes = Readonly<Record<string, Value>>;

export interface HeaderRecord {
  readonly sop_class: string;
  readonly transfer_syntax: string;
  readonly pixels: string;
  readonly attributes: Attributes;
  readonly shared: Attributes;
  readonly frames: readonly Attributes[];
}

/** Attributes that `lumencut-dicom` needs, each with the functional groups that may contain it. */
export type Asked = Readonly<Record<string, readonly string[]>>;

type Elements = Readonly<Record<string, Element>>;

export class Recorder {
  private readonly keywords: readonly string[];
  private readonly groups = new Map<string, string[]>();

  constructor(asked: Asked) {
    this.keywords = Object.keys(asked);
    for (const [keyword, sequences] of Object.entries(asked)) {
      for (const sequence of sequences) {
        this.groups.set(sequence, [...(this.groups.get(sequence) ?? []), keyword]);
      }
    }
  }

  record(file: Parsed): HeaderRecord {
    const reader = new Reader(file);
    const [shared] = itemsOf(file.elements, TAGS.shared);
    return {
      sop_class: reader.text(TAGS.sopClass) || reader.text(TAGS.mediaSopClass),
      transfer_syntax: file.syntax,
      pixels: file.pixels?.keyword ?? '',
      attributes: this.attributes(reader, file.elements, this.keywords),
      shared: shared ? this.ofGroups(reader, shared) : {},
      frames: itemsOf(file.elements, TAGS.perFrame).map((frame) => this.ofGroups(reader, frame)),
    };
  }

  private attributes(reader: Reader, elements: Elements, keywords: readonly string[]): Record<string, Value> {
    const found: Record<string, Value> = {};
    for (const keyword of keywords) {
      const value = reader.value(elements, keyword);
      if (value !== undefined) {
        found[keyword] = value;
      }
    }
    return found;
  }

  /** Merges functional groups; the first group that contains an attribute decides. */
  private ofGroups(reader: Reader, groups: Elements): Attributes {
    let found: Record<string, Value> = {};
    for (const [sequence, keywords] of this.groups) {
      const [item] = itemsOf(groups, attribute(sequence)?.tag ?? '');
      found = item ? { ...this.attributes(reader, item, keywords), ...found } : found;
    }
    return found;
  }
}

class Reader {
  private readonly decoder: TextDecoder;

  constructor(private readonly file: Parsed) {
    const sets = file.elements[TAGS.characterSet];
    this.decoder = decoderOf(sets ? textsOf(file, sets) : []);
  }

  text(tag: string): string {
    const element = this.file.elements[tag];
    if (element) {
      return textsOf(this.file, element)[0] ?? '';
    }
    const meta = this.file.meta[tag];
    return meta ? (textsOf(this.file, meta)[0] ?? '') : '';
  }

  value(elements: Elements, keyword: string): Value | undefined {
    const known = attribute(keyword);
    const element = known ? elements[known.tag] : undefined;
    if (!known || !element) {
      return undefined;
    }
    const stated = element.vr && element.vr !== 'UN' ? element.vr : known.vr;
    return valueIn(this.file, element, stated === 'US or SS' ? this.signed() : stated, this.decoder);
  }

  /** The signed or unsigned type, according to Pixel Representation. */
  private signed(): string {
    return this.value(this.file.elements, 'PixelRepresentation') === 1 ? 'SS' : 'US';
  }
}

function itemsOf(elements: Elements, tag: string): Elements[] {
  const items = elements[tag]?.items ?? [];
  return items.map((item) => item.dataSet?.elements ?? {});
}
