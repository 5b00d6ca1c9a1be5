/** Dropped or chosen files, with their paths. */
import type { GivenFile } from '../core/messages';

export function chosen(list: FileList): GivenFile[] {
  return [...list].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** Dropped files, including those in dropped folders. Call it within the event handler. */
export async function dropped(transfer: DataTransfer): Promise<GivenFile[]> {
  const items = [...transfer.items].filter((item) => item.kind === 'file');
  const entries = items.map((item) => item.webkitGetAsEntry());
  const files = items.map((item) => item.getAsFile());
  const found = await Promise.all(
    entries.map((entry, i) => (entry ? below(entry) : alone(files[i] ?? null))),
  );
  return found.flat();
}

function alone(file: File | null): GivenFile[] {
  return file ? [{ path: file.name, file }] : [];
}

async function below(entry: FileSystemEntry): Promise<GivenFile[]> {
  if (entry.isFile) {
    const file = await new Promise<File>((given, refused) =>
      (entry as FileSystemFileEntry).file(given, refused),
    );
    return [{ path: entry.fullPath.replace(/^\//, ''), file }];
  }
  const found: GivenFile[] = [];
  for (const inside of await entriesOf(entry as FileSystemDirectoryEntry)) {
    found.push(...(await below(inside)));
  }
  return found;
}

/** All entries of a folder, which browsers return in batches. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const found: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((given, refused) => reader.readEntries(given, refused));
    if (some.length === 0) {
      return found;
    }
    found.push(...some);
  }
}
