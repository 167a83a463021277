"""Does to a window what a user does, by libX11 alone: send_input.py TITLE ACTION...

Actions: move:X,Y  press:BUTTON  release:BUTTON  key:KEYSYM  hold:KEYSYM  let:KEYSYM  close  as X numbers buttons (4 and
5 are the wheel's) and names keys. What is held changes the keys that follow."""

import ctypes
import sys

X = ctypes.CDLL("libX11.so.6")
Id = ctypes.c_ulong
Pointer = ctypes.c_void_p


class Input(ctypes.Structure):  # a key or a button
    _fields_ = [("type", ctypes.c_int), ("serial", Id), ("send_event", ctypes.c_int), ("display", Pointer),
                ("window", Id), ("root", Id), ("subwindow", Id), ("time", Id), ("x", ctypes.c_int), ("y", ctypes.c_int),
                ("x_root", ctypes.c_int), ("y_root", ctypes.c_int), ("state", ctypes.c_uint), ("code", ctypes.c_uint),
                ("same_screen", ctypes.c_int)]


class Message(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", Id), ("send_event", ctypes.c_int), ("display", Pointer),
                ("window", Id), ("message_type", Id), ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("input", Input), ("message", Message), ("pad", ctypes.c_long * 24)]


KEY_PRESS, KEY_RELEASE, BUTTON_PRESS, BUTTON_RELEASE, CLIENT_MESSAGE = 2, 3, 4, 5, 33
MASKS = {KEY_PRESS: 1, KEY_RELEASE: 2, BUTTON_PRESS: 4, BUTTON_RELEASE: 8, CLIENT_MESSAGE: 0}
HELD = {"Shift_L": 1, "Control_L": 4, "Alt_L": 8}

X.XOpenDisplay.restype = Pointer
X.XDefaultRootWindow.restype = X.XInternAtom.restype = X.XStringToKeysym.restype = Id
X.XDefaultRootWindow.argtypes = [Pointer]
X.XInternAtom.argtypes = [Pointer, ctypes.c_char_p, ctypes.c_int]
X.XKeysymToKeycode.restype = ctypes.c_ubyte
X.XKeysymToKeycode.argtypes = [Pointer, Id]
X.XQueryTree.argtypes = [Pointer, Id] + [ctypes.POINTER(Id)] * 2 + [ctypes.POINTER(ctypes.POINTER(Id)),
                                                                   ctypes.POINTER(ctypes.c_uint)]
X.XFetchName.argtypes = [Pointer, Id, ctypes.POINTER(ctypes.c_char_p)]
X.XWarpPointer.argtypes = [Pointer, Id, Id] + [ctypes.c_int] * 2 + [ctypes.c_uint] * 2 + [ctypes.c_int] * 2
X.XSendEvent.argtypes = [Pointer, Id, ctypes.c_int, ctypes.c_long, ctypes.POINTER(Event)]
X.XSync.argtypes = [Pointer, ctypes.c_int]

display = X.XOpenDisplay(None)
root = X.XDefaultRootWindow(display)
state = 0
where = (0, 0)


def window_named(title):
    ignored, parent, children, count = Id(), Id(), ctypes.POINTER(Id)(), ctypes.c_uint()
    X.XQueryTree(display, root, ctypes.byref(ignored), ctypes.byref(parent), ctypes.byref(children),
                 ctypes.byref(count))
    for i in range(count.value):
        name = ctypes.c_char_p()
        if X.XFetchName(display, children[i], ctypes.byref(name)) and name.value == title.encode():
            return children[i]
    sys.exit(f"no window is called {title}")


def send(kind, code):
    event = Event()
    event.input = Input(kind, 0, 1, display, window, root, 0, 0, *where, *where, state, code, 1)
    X.XSendEvent(display, window, 1, MASKS[kind], ctypes.byref(event))


def code_of(name):
    code = X.XKeysymToKeycode(display, X.XStringToKeysym(name.encode()))
    return code or sys.exit(f"no key gives {name}")


window = window_named(sys.argv[1])
for action in sys.argv[2:]:
    verb, _, what = action.partition(":")
    if verb == "move":
        where = tuple(int(number) for number in what.split(","))
        X.XWarpPointer(display, 0, window, 0, 0, 0, 0, *where)
    elif verb in ("press", "release"):
        send(BUTTON_PRESS if verb == "press" else BUTTON_RELEASE, int(what))
    elif verb == "key":
        send(KEY_PRESS, code_of(what))
        send(KEY_RELEASE, code_of(what))
    elif verb == "hold":
        send(KEY_PRESS, code_of(what))
        state |= HELD[what]
    elif verb == "let":
        send(KEY_RELEASE, code_of(what))
        state &= ~HELD[what]
    elif verb == "close":
        event = Event()
        protocols, close = (X.XInternAtom(display, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW"))
        event.message = Message(CLIENT_MESSAGE, 0, 1, display, window, protocols, 32, (ctypes.c_long * 5)(close))
        X.XSendEvent(display, window, 0, 0, ctypes.byref(event))
    else:
        sys.exit(f"no such action: {action}")
X.XSync(display, 0)
