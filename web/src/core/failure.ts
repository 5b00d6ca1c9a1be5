/** Errors in the words of the whole of Lumencut: what is wrong, what was found, what was expected, what mends it. */
export class Failure extends Error {
  constructor(
    readonly kind: string,
    readonly subject: string,
    readonly found: string,
    readonly expected: string,
    readonly mend = '',
  ) {
    const words = [`${subject}: found ${found}`, `expected ${expected}`, mend];
    super(words.filter((part) => part !== '').join('; '));
    this.name = 'Failure';
  }

  /** What was thrown as a failure: the JSON that the core throws, or any other error in its own words. */
  static of(thrown: unknown): Failure {
    if (thrown instanceof Failure) {
      return thrown;
    }
    const text = thrown instanceof Error ? thrown.message : String(thrown);
    const fields = parsed(text);
    if (fields) {
      return new Failure(fields.kind, fields.subject, fields.found, fields.expected, fields.mend);
    }
    return new Failure(
      'unexpected',
      'the page',
      text,
      'no error here',
      'reload the page and open the scan again',
    );
  }

  /** As a text that survives the way between worker and page; `of` reads it again. */
  get text(): string {
    const { kind, subject, found, expected, mend } = this;
    return JSON.stringify({ kind, subject, found, expected, mend });
  }
}

interface Fields {
  kind: string;
  subject: string;
  found: string;
  expected: string;
  mend: string;
}

function parsed(text: string): Fields | null {
  try {
    const fields: unknown = JSON.parse(text);
    const names = ['kind', 'subject', 'found', 'expected', 'mend'] as const;
    if (fields === null || typeof fields !== 'object') {
      return null;
    }
    return names.every((name) => typeof (fields as Fields)[name] === 'string') ? (fields as Fields) : null;
  } catch {
    return null;
  }
}
