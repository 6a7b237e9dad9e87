// One block of Fanuc Custom Macro B, Mazak EIA or Haas text. Tokens come from frontend/fanuc/token_source; their kinds stand in
// frontend/fanuc/token_kinds.def in this order. What the words of a block mean together is decided when it is lowered.
parser grammar FanucParser;

tokens {
  Skip, SkipRest, BlockNumber, ProgramNumber, Name,
  WordValue, Address,
  Cell, CellAt, Number, Function, Atan, Parameter,
  If, Then, Else, EndIf, While, Do, End, Goto,
  Open, Close, Print, PrintText, PrintFormat,
  Equals, EqualTo, NotEqual, Less, LessEqual, Greater, GreaterEqual,
  Plus, Minus, Star, Slash, Modulo, And, Or, Xor, BothTrue, OneTrue,
  LeftBracket, RightBracket, Comma, Refused
}

// The skip mark stands before or behind the number (`/1N10`, `N10/1`).
block : Skip? BlockNumber? Skip? head? statement? EOF ;
head : ProgramNumber Name? | Name ;

statement
  : If condition Then                            # ifStatement
  | If condition Then? item+ EndIf?              # guardedStatement
  | condition item+                              # guardedStatement2
  | Else                                         # elseStatement
  | EndIf                                        # endIfStatement
  | While condition Do Number                    # whileStatement
  | Do Number                                    # doStatement
  | End Number                                   # endStatement
  | item+                                        # itemsStatement
  ;

item
  : WordValue                                    # constantItem
  | Address expression                           # wordItem
  | Name                                         # nameItem
  | SkipRest                                     # skipItem
  | variable Equals joined                       # assignItem
  | Goto target                                  # jumpItem
  | Print LeftBracket printed* RightBracket      # printItem
  | Open                                         # openItem
  | Close                                        # closeItem
  ;
target : Number | expression ;
printed : PrintText | variable PrintFormat ;

// Card 4.6: conditions stand in brackets; several may be joined, also outside of an outer pair.
condition : bracket (op+=(And | Or | Xor | BothTrue | OneTrue) bracket)* ;
bracket : LeftBracket joined RightBracket ;
joined : comparison (op+=(BothTrue | OneTrue) comparison)* ;
comparison : expression (op=(EqualTo | NotEqual | Less | LessEqual | Greater | GreaterEqual) expression)? ;

// Card 4.1, tightest first.
expression
  : primary                                                # primaryExpression
  | op=(Minus | Plus) primary                              # unaryExpression
  | expression op=(Star | Slash | Modulo | And) expression # binaryExpression
  | expression op=(Plus | Minus | Or | Xor) expression     # binaryExpression
  ;

// ATAN[a]/[b] has two arguments, [ATAN[a]]/[b] is a quotient (card 4.3).
primary
  : Number                                                                                          # numberPrimary
  | variable                                                                                        # variablePrimary
  | Atan LeftBracket expression RightBracket Slash LeftBracket expression RightBracket              # atanPrimary
  | Atan LeftBracket expression (Comma expression)? RightBracket                                    # atanPrimary
  | Function LeftBracket expression (Comma expression)? RightBracket                                # functionPrimary
  | Parameter LeftBracket expression (Comma expression)? RightBracket (Slash LeftBracket expression RightBracket)? # functionPrimary
  | bracket                                                                                         # groupPrimary
  ;
variable
  : Cell                                         # cellVariable
  | CellAt LeftBracket expression RightBracket   # cellAtVariable
  ;
