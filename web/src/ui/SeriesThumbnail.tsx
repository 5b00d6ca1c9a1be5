/** Thumbnail of a series. */
import { useEffect, useRef } from 'preact/hooks';
import type { Thumbnail } from '../core/failure';

export function SeriesThumbnail({ of }: { readonly of: Thumbnail }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { width, height, grey } = of;
  useEffect(() => {
    const rgba = Uint8ClampedArray.from(grey.flatMap((value) => [value, value, value, 255]));
    canvas.current?.getContext('2d')?.putImageData(new ImageData(rgba, width, height), 0, 0);
  }, [of]);
  return <canvas ref={canvas} width={width} height={height} data-testid="series-thumbnail" aria-hidden />;
}
