// One block (line) of flat ISO: literal words only. Tokens come from frontend/iso/token_source; their kinds stand in
// frontend/iso/token_kinds.def in this order.
parser grammar IsoParser;

tokens {
  BlockNumber, ProgramNumber, Code, Auxiliary, Axis, Center, Radius, Feed, Speed, Tool, Length, Offset,
  Dwell, Limit, ExtendedOffset, Parameter
}

block : BlockNumber? statement? EOF ;

statement
  : ProgramNumber
  | Dwell (Parameter | Axis)   // the profile says which: G4 P2., G4 X2.
  | Limit Speed                // G92 S3000
  | word+
  ;

word
  : Code
  | ExtendedOffset Parameter   // G54.1 P3
  | Auxiliary
  | Axis
  | Center
  | Radius
  | Feed
  | Speed
  | Tool
  | Length
  | Offset
  ;
