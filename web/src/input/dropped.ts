/** Files out of a drop or a choice, with the folders that they are in. */
import type { GivenFile } from '../core/messages';

/** The files that were chosen. */
export function chosen(list: FileList): GivenFile[] {
  return [...list].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/** The files that were dropped, with those of dropped folders. To be called while the event is handled. */
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

/** The entries of a folder, which a browser gives some at a time. */
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
