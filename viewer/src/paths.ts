// SPDX-License-Identifier: MIT
// Parts of paths.

/** The name of a file without its folder. */
export const baseName = (path: string): string => path.slice(path.lastIndexOf('/') + 1);

const dotOf = (path: string): number => {
  const name = baseName(path);
  const dot = name.lastIndexOf('.');
  return path.length - name.length + (dot > 0 ? dot : name.length);
};

/** The name of a file without its folder and extension. */
export const stemOf = (path: string): string => baseName(path.slice(0, dotOf(path)));

/** The extension of a file, with its dot. */
export const extensionOf = (path: string): string => path.slice(dotOf(path));

const kByNumber = new Intl.Collator('en', {numeric: true});

/** The order in which people count: take 2 before take 10. */
export const inOrder = (paths: Iterable<string>): string[] =>
  [...paths].sort((a, b) => kByNumber.compare(a, b));
