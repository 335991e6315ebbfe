// A text that is taken once it was typed: what stands in the field meanwhile stays, whatever is
// drawn anew around it.

import { useState } from "preact/hooks";

type Field = { currentTarget: HTMLInputElement | HTMLTextAreaElement };

export function useTyping(text: string, take: (text: string) => void) {
  const [typing, setTyping] = useState<string | null>(null);
  return {
    value: typing ?? text,
    onInput: ({ currentTarget }: Field) => setTyping(currentTarget.value),
    onChange: ({ currentTarget }: Field) => take(currentTarget.value),
    onBlur: () => setTyping(null),
  };
}
