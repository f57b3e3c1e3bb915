// What the page uses of preact with htm (third_party/htm), for tests/page_types.py.
export function html(strings: TemplateStringsArray, ...values: unknown[]): unknown;
export function render(what: unknown, into: Element | null): void;
export function useState<T>(initial: T | (() => T)): [T, (value: T | ((before: T) => T)) => void];
export function useEffect(act: () => void | (() => void), given?: unknown[]): void;
export function useRef<T>(initial: T): { current: T };
