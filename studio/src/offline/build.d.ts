// What the build of the single file puts in.

declare const PROGRAM: string;
declare module "*?worker&inline" {
  const made: new () => Worker;
  export default made;
}
