// An element whose content is made by others: text, charts, drawings.

import { Component, createRef, type RefObject } from "preact";

interface Props {
  of: (element: HTMLElement) => void;
  kind?: "div" | "section";
  class?: string;
  label?: string;
}

export class Host extends Component<Props> {
  private readonly own = createRef<HTMLElement>();
  override componentDidMount(): void {
    this.props.of(this.own.current!);
  }
  override shouldComponentUpdate(): boolean {
    return false;
  }
  override render() {
    const { kind, label, class: name } = this.props,
      own = this.own;
    return kind === "section" ? (
      <section ref={own} class={name} aria-label={label} />
    ) : (
      <div ref={own as RefObject<HTMLDivElement>} class={name} />
    );
  }
}
