/** Requests to `lumencut view`, the Python server of the page; other web servers do not offer these services. */
import { Failure } from './failure';

export type Made = 'objects' | 'study' | 'mask';

/** Address of a service. Throws if the server of the page does not offer it. */
export function placeOf(made: Made, subject: string): string {
  const address = document.querySelector<HTMLMetaElement>(`meta[name="lumencut-${made}"]`)?.content;
  if (address) {
    return address;
  }
  const advice = 'open the scan with `lumencut view`, installed with pip install "lumencut[dicom,plot]"';
  throw new Failure(
    'file',
    subject,
    'a page without its server',
    'the server, which reads and writes DICOM',
    advice,
  );
}

/** Posts content as JSON to a service. Throws `Failure`. */
export async function made(what: Made, subject: string, content: object): Promise<Response> {
  const response = await fetch(placeOf(what, subject), {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(content),
  });
  if (response.ok) {
    return response;
  }
  const failure = Failure.of(await response.text());
  const advice =
    response.status === 503
      ? 'wait until the current export is done'
      : 'check the program that serves the page';
  throw failure.kind === 'unexpected'
    ? new Failure('file', subject, `HTTP status ${response.status}`, 'status 200', advice)
    : failure;
}

export function inBase64(bytes: Blob): Promise<string> {
  return new Promise((resolve) => {
    const reader = new FileReader();
    reader.onload = () => resolve(String(reader.result).split(',')[1] ?? '');
    reader.readAsDataURL(bytes);
  });
}
