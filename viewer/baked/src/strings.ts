// What the page says, in English and German.
import type { FileFault } from "./bad_file.js";

const kEnglish = {
  loading: "Loading the home …",
  loadingLight: "Loading the light …",
  fault_missing: "There is no home in this page. Make one with roomlight bake.",
  fault_unserved:
    "This page is part of a folder, which wants a web server. To open one file: roomlight bake -o home.html.",
  fault_foreign: "This file is not a home baked by roomlight.",
  fault_cut: "The file of this home is cut off. Copy or download it again.",
  fault_damaged: "The file of this home is damaged. Copy or download it again.",
  fault_newer: "This home was baked by a newer roomlight than this page knows.",
  noWebGl:
    "This browser cannot show the home: it has no WebGL 2. Turn on hardware acceleration, or try another browser.",
  noFloat: "This graphics processor cannot add up light: it cannot draw to 16-bit floating point.",
  tooLarge: "The light of this home is too large for this graphics processor.",
  contextLost: "The graphics processor was taken away. The home comes back as soon as it is there again.",
  failed: "Something went wrong. Reload the page.",
  view: "View of the home. Arrow keys or W, A, S, D walk; drag looks around; click on the floor goes there.",
  panel: "Controls",
  openPanel: "Open controls",
  closePanel: "Close controls",
  light: "Light",
  lamps: "Lamps",
  otherRoom: "Elsewhere",
  allInRoom: "All of {0}",
  on: "{0}: on",
  level: "{0}: brightness",
  kelvin: "{0}: colour temperature",
  ownKelvin: "Own colour",
  noLamps: "This home has no lamps.",
  daylight: "Daylight",
  sun: "Sun",
  sky: "Sky",
  hour: "Time of day",
  scenes: "Scenes",
  asBaked: "As baked",
  everythingOn: "Everything on",
  evening: "Evening",
  saveScene: "Save as scene",
  sceneName: "Name of the scene",
  deleteScene: "Delete {0}",
  notStored: "The browser does not keep scenes: its storage is full or denied. Copy the link instead.",
  picture: "Picture",
  autoExposure: "Automatic exposure",
  exposure: "Exposure, EV",
  falseColours: "Illuminance in false colours",
  meter: "Light meter",
  meterHint: "Point at a surface.",
  legend: "Illuminance, lux",
  places: "Places",
  rooms: "Rooms",
  cameras: "Cameras",
  camera: "Camera {0}",
  map: "Plan: click goes there",
  throughWalls: "Walk through walls",
  fov: "Angle of view",
  screenshot: "Save picture",
  fullscreen: "Full screen",
  copyLink: "Copy link",
  copied: "The link is copied.",
  notCopied: "The browser does not let this page copy. The link is in the address bar.",
  enterVr: "Enter VR",
  vrFailed: "The headset did not start.",
  language: "Language",
  stick: "Walk: drag the stick",
  help: "Keys",
  help1: "W A S D or arrows: walk; Shift: faster",
  help2: "Q, E, Page Up, Page Down or drag: look around; wheel: angle of view",
  help3: "Click on a floor: go there",
  help4: "F: false colours; M: light meter; P: save picture",
};

export type StringKey = keyof typeof kEnglish;
export type Language = "en" | "de";

const kGerman: Record<StringKey, string> = {
  loading: "Die Wohnung wird geladen …",
  loadingLight: "Das Licht wird geladen …",
  fault_missing: "In dieser Seite ist keine Wohnung. roomlight bake erzeugt eine.",
  fault_unserved:
    "Diese Seite gehört zu einem Ordner, der einen Webserver braucht. Als einzelne Datei: roomlight bake -o home.html.",
  fault_foreign: "Diese Datei ist keine von roomlight gebackene Wohnung.",
  fault_cut: "Die Datei dieser Wohnung ist abgeschnitten. Bitte erneut kopieren oder herunterladen.",
  fault_damaged: "Die Datei dieser Wohnung ist beschädigt. Bitte erneut kopieren oder herunterladen.",
  fault_newer: "Diese Wohnung stammt von einem neueren roomlight, als diese Seite kennt.",
  noWebGl:
    "Dieser Browser kann die Wohnung nicht zeigen: Ihm fehlt WebGL 2. Bitte " +
    "Hardwarebeschleunigung einschalten oder einen anderen Browser nehmen.",
  noFloat: "Dieser Grafikprozessor kann Licht nicht addieren: Er zeichnet nicht in 16-Bit-Gleitkommazahlen.",
  tooLarge: "Das Licht dieser Wohnung ist zu groß für diesen Grafikprozessor.",
  contextLost: "Der Grafikprozessor wurde entzogen. Die Wohnung erscheint wieder, sobald er zurück ist.",
  failed: "Etwas ist schiefgegangen. Bitte die Seite neu laden.",
  view:
    "Ansicht der Wohnung. Pfeiltasten oder W, A, S, D gehen; Ziehen " +
    "blickt umher; ein Klick auf den Boden führt dorthin.",
  panel: "Bedienung",
  openPanel: "Bedienung öffnen",
  closePanel: "Bedienung schließen",
  light: "Licht",
  lamps: "Leuchten",
  otherRoom: "Anderswo",
  allInRoom: "Alle in {0}",
  on: "{0}: an",
  level: "{0}: Helligkeit",
  kelvin: "{0}: Farbtemperatur",
  ownKelvin: "Eigene Farbe",
  noLamps: "Diese Wohnung hat keine Leuchten.",
  daylight: "Tageslicht",
  sun: "Sonne",
  sky: "Himmel",
  hour: "Uhrzeit",
  scenes: "Szenen",
  asBaked: "Wie gebacken",
  everythingOn: "Alles an",
  evening: "Abend",
  saveScene: "Als Szene speichern",
  sceneName: "Name der Szene",
  deleteScene: "{0} löschen",
  notStored:
    "Der Browser behält keine Szenen: Sein Speicher ist voll oder gesperrt. Kopieren Sie stattdessen den Link.",
  picture: "Bild",
  autoExposure: "Automatische Belichtung",
  exposure: "Belichtung, EV",
  falseColours: "Beleuchtungsstärke in Falschfarben",
  meter: "Luxmeter",
  meterHint: "Auf eine Fläche zeigen.",
  legend: "Beleuchtungsstärke, Lux",
  places: "Orte",
  rooms: "Räume",
  cameras: "Kameras",
  camera: "Kamera {0}",
  map: "Grundriss: Klick führt dorthin",
  throughWalls: "Durch Wände gehen",
  fov: "Bildwinkel",
  screenshot: "Bild speichern",
  fullscreen: "Vollbild",
  copyLink: "Link kopieren",
  copied: "Der Link ist kopiert.",
  notCopied: "Der Browser lässt diese Seite nicht kopieren. Der Link steht in der Adresszeile.",
  enterVr: "VR starten",
  vrFailed: "Die VR-Brille ist nicht gestartet.",
  language: "Sprache",
  stick: "Gehen: Stick ziehen",
  help: "Tasten",
  help1: "W A S D oder Pfeile: gehen; Umschalt: schneller",
  help2: "Q, E, Bild auf, Bild ab oder Ziehen: umherblicken; Rad: Bildwinkel",
  help3: "Klick auf einen Boden: dorthin gehen",
  help4: "F: Falschfarben; M: Luxmeter; P: Bild speichern",
};

export const kStrings: Readonly<Record<Language, Readonly<Record<StringKey, string>>>> = { en: kEnglish, de: kGerman };

export const languageOf = (browser: string): Language => (/^de\b/i.test(browser) ? "de" : "en");

export type Say = (key: StringKey, ...values: readonly (string | number)[]) => string;

export const speaker =
  (language: Language): Say =>
  (key, ...values) =>
    kStrings[language][key].replace(/\{(\d)\}/g, (_, i: string) => String(values[Number(i)] ?? ""));

export const faultKey = (fault: FileFault): StringKey => `fault_${fault}`;
